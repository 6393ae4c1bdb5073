// A progress bar with the time left, on stderr. Silent where stderr is no terminal, but for one
// line as a stage begins.
//
// With `after`: for those who have waited for so long; before, and without a terminal, silent.
#pragma once

#include <chrono>
#include <exception>
#include <string>

namespace twinarm {

class Progress {
 public:
  static constexpr double kPatience = 2;  // [s]
  explicit Progress(bool quiet, double after = 0);
  ~Progress();
  // `weight` is the share of the whole that this stage is expected to take.
  void stage(const std::string& name, double weight);
  void advance(double fraction_of_stage);          // in [0, 1], of the current stage
  void at(const std::string& name, double share);  // in place of stages: of the whole
  void finish();
  double seconds() const;  // since it was made

 private:
  void draw();
  bool terminal_, quiet_;
  double after_;  // [s]
  std::string name_;
  double done_ = 0, weight_ = 0, fraction_ = 0;
  std::chrono::steady_clock::time_point start_, drawn_;
};

// Ctrl-C, or a terminal that is closed: asked for once, noticed at the next safe point, so that no
// half file stays behind.
struct Interrupted : std::exception {
  const char* what() const noexcept override { return "interrupted"; }
};

void catch_interrupts();  // from now on SIGINT, SIGTERM and SIGHUP only set a flag
bool is_interrupted();    // whether it is set
void forget_interrupt();  // it has been obeyed: what is still to be done has a Ctrl-C of its own
void check_interrupt();   // throws Interrupted once the flag is set

// Times of the clock that never jumps, in seconds.
inline double as_seconds(std::chrono::steady_clock::duration time) noexcept {
  return std::chrono::duration<double>(time).count();
}
inline double steady_seconds() noexcept {
  return as_seconds(std::chrono::steady_clock::now().time_since_epoch());
}

}  // namespace twinarm
