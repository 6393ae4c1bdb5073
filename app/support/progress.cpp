#include "app/support/progress.h"

#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>

#include "app/support/files.h"

namespace twinarm {

Progress::Progress(bool quiet, double after)
    : terminal_(isatty(STDERR_FILENO) == 1),
      quiet_(quiet || (after > 0 && !terminal_)),
      after_(after),
      start_(std::chrono::steady_clock::now()),
      drawn_(start_) {}

Progress::~Progress() {
  finish();
}

void Progress::stage(const std::string& name, double weight) {
  done_ += weight_;
  weight_ = weight;
  fraction_ = 0;
  name_ = name;
  if (quiet_) return;
  if (terminal_)
    draw();
  else
    print_error("{}\n", name_);
}

void Progress::advance(double fraction_of_stage) {
  fraction_ = std::clamp(fraction_of_stage, 0.0, 1.0);
  if (!quiet_ && terminal_ &&
      std::chrono::steady_clock::now() - drawn_ > std::chrono::milliseconds(100))
    draw();
}

void Progress::at(const std::string& name, double share) {
  name_ = name;
  done_ = share;
  advance(0);
}

double Progress::seconds() const {
  return as_seconds(std::chrono::steady_clock::now() - start_);
}

void Progress::finish() {
  if (!quiet_ && terminal_ && !name_.empty() && seconds() >= after_) print_error("\r\033[K");
  std::fflush(stderr);
  name_.clear();
}

void Progress::draw() {
  const double elapsed = seconds();
  if (elapsed < after_) return;
  drawn_ = std::chrono::steady_clock::now();
  const double done = std::clamp(done_ + weight_ * fraction_, 0.0, 1.0);
  constexpr int width = 28;
  const int full = static_cast<int>(done * width);
  std::string left;
  if (done > 0.03) left = fmt::format("  {:.0f} s left", elapsed * (1 - done) / done);
  print_error("\r\033[K[{}{}] {:3.0f} %  {}{}", std::string(full, '#'),
              std::string(width - full, '.'), 100 * done, name_, left);
  std::fflush(stderr);
}

namespace {

volatile std::sig_atomic_t interrupted = 0;

// A command that does not look at the flag for so much processor time is ended by SIGPROF.
constexpr itimerval kPatience{{0, 0}, {0, 900'000}}, kNone{};  // [s, us]

void end_at_once(int) {
  constexpr std::string_view words = "twinarm: interrupted\n";
  remove_temporary_paths();
  [[maybe_unused]] const ssize_t wrote = write(STDERR_FILENO, words.data(), words.size());
  _exit(130);  // docs/reference/exit_codes_and_errors.md
}

}  // namespace

void catch_interrupts() {
  const auto note = [](int) {
    interrupted = 1;
    setitimer(ITIMER_PROF, &kPatience, nullptr);
  };
  std::signal(SIGPROF, end_at_once);
  std::signal(SIGINT, note);
  std::signal(SIGTERM, note);
  if (std::signal(SIGHUP, note) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
  std::signal(SIGXFSZ, SIG_IGN);  // write() reports the size limit
}

bool is_interrupted() {
  if (interrupted == 0) return false;
  setitimer(ITIMER_PROF, &kNone, nullptr);
  return true;
}

void forget_interrupt() {
  interrupted = 0;
}

void check_interrupt() {
  if (is_interrupted()) throw Interrupted();
}

}  // namespace twinarm
