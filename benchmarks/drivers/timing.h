// Timing of several jobs with comparable conditions on a loaded machine; progress of the programs.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/engines/engine.h"

namespace twinarm::bench {

struct Timing {
  double ns = 0;      // thread CPU time of one call of the job, median of the repetitions
  double spread = 0;  // (longest - shortest) / median
};

// NAN of no values.
inline double median_of(std::vector<double> values) {
  if (values.empty()) return NAN;
  std::ranges::sort(values);
  return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}
// (longest - shortest) / median.
inline double spread_of(const std::vector<double>& values) {
  const auto [low, high] = std::ranges::minmax(values);
  return (high - low) / median_of(values);
}

inline double seconds_of(const std::function<void()>& job, long calls) {
  const double start = thread_seconds();
  for (long n = 0; n < calls; ++n) job();
  return thread_seconds() - start;
}
// The number of calls that take about this time; also warms up.
inline long calls_in(double seconds, const std::function<void()>& job) {
  long calls = 1;
  double spent = seconds_of(job, calls);
  for (; spent < seconds / 10; spent = seconds_of(job, calls)) calls *= 10;
  return std::max(1L, std::lround(seconds / spent * static_cast<double>(calls)));
}

// In every repetition all jobs run one after the other, each for about `seconds`, so that a
// temporary load affects all.
inline std::vector<Timing> time_interleaved(const std::vector<std::function<void()>>& jobs,
                                            int repetitions, double seconds) {
  std::vector<long> calls;
  for (const auto& job : jobs) calls.push_back(calls_in(seconds, job));
  std::vector<std::vector<double>> ns(jobs.size());
  for (int repetition = 0; repetition < repetitions; ++repetition)
    for (std::size_t i = 0; i < jobs.size(); ++i)
      ns[i].push_back(1e9 * seconds_of(jobs[i], calls[i]) / static_cast<double>(calls[i]));
  std::vector<Timing> timings;
  for (const std::vector<double>& of_job : ns)
    timings.push_back({median_of(of_job), spread_of(of_job)});
  return timings;
}

// Progress on stderr, with the estimated time left: one line that is redrawn on a terminal;
// elsewhere a line every 5 s at most. The time of a stage is assumed to be proportional to its
// weight.
class Stages {
 public:
  Stages(std::string program, double total) : program_(std::move(program)), total_(total) {}
  ~Stages() {
    if (terminal_) std::cerr << "\r\033[K" << std::flush;
  }
  Stages(const Stages&) = delete;
  Stages& operator=(const Stages&) = delete;

  void begin(const std::string& what, double weight = 1) {
    const double passed = seconds();
    if (done_ == 0 || passed - printed_ > (terminal_ ? 0.1 : 5)) {
      std::cerr << (terminal_ ? "\r\033[K" : "") << program_ << ": ";
      if (done_ > 0)
        std::cerr << std::lround(100 * done_ / total_) << " %, about "
                  << std::lround(passed / done_ * (total_ - done_)) << " s left: ";
      std::cerr << what << (terminal_ ? "" : "\n") << std::flush;
      printed_ = passed;
    }
    done_ += weight;
  }
  // Reduces the total weight; a negative weight increases it.
  void skip(double weight) { total_ -= weight; }

 private:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  std::string program_;
  double total_, done_ = 0, printed_ = 0;
  const bool terminal_ = isatty(STDERR_FILENO) == 1;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace twinarm::bench
