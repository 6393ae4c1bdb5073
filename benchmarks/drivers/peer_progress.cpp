#include "benchmarks/drivers/peer_progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace twinarm::bench {

Progress::Progress(int repetitions, double budget)
    : repetitions_(repetitions > 1 ? repetitions : 0),
      budget_(budget),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
  if (terminal_) std::cerr << "\r\033[K" << std::flush;
}

void Progress::expect(const Row& row) {
  guesses_.push_back(guess(row));
}

void Progress::begin(const Row& row, const std::string& again) {
  constexpr double kTooEarly = 2;  // seconds, before which nobody can say
  if (!again.empty() && clock() - drawn_ < (terminal_ ? 0.1 : 5)) return;
  drawn_ = clock();
  std::cerr << (terminal_ ? "\r\033[K" : "") << "bench_peers: ";
  if (clock() > kTooEarly) {
    const double part = clock() / (clock() + left());
    std::cerr << std::lround(100 * part) << " %, about " << std::lround(std::ceil(left()))
              << " s left: ";
  }
  std::cerr << row.test->name << ", " << row.name << ' ' << row.scheme.name << again
            << (terminal_ ? "" : "\n") << std::flush;
}

void Progress::saw(const Row& row, bool to_be_repeated) {
  const double took = row.seconds.empty() ? 0 : row.seconds.front();
  const Guess& expected = guesses_.at(seen_++);
  guessed_[expected.contacts] += expected.seconds, taken_[expected.contacts] += took;
  spent_ += took;
  if (to_be_repeated) to_repeat_ += repetitions_ * took;
}

void Progress::repeated(double seconds) {
  to_repeat_ -= seconds, spent_ += seconds;
}

// A step costs a microsecond for each body, ten with contacts.
Progress::Guess Progress::guess(const Row& row) const {
  constexpr double kAdaptive = 0.05;
  const Scene& scene = row.test->scene;
  if (row.scheme.adaptive) return {scene.floor, kAdaptive};
  const double step = (scene.floor ? 1e-5 : 1e-6) * static_cast<double>(scene.bodies.size());
  return {scene.floor, row.test->duration / row.h * step};
}

double Progress::left() const {
  double to_come = std::max(to_repeat_, 0.0);
  for (std::size_t i = seen_; i < guesses_.size(); ++i) {
    const bool contacts = guesses_[i].contacts;
    const double run =
        std::min(guesses_[i].seconds * taken_[contacts] / guessed_[contacts], budget_);
    to_come += run < kOnceIsEnough ? run * (1 + repetitions_) : run;
  }
  return to_come * (spent_ > 0 ? clock() / spent_ : 1);
}

double Progress::clock() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

}  // namespace twinarm::bench
