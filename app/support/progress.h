// A progress bar with remaining time on stderr. If stderr is not a terminal, one line per stage.
// With `after` > 0 it appears after that time [s], and only on a terminal.
#pragma once

#include <chrono>
#include <cstddef>
#include <exception>
#include <string>

namespace twinarm {

// Ctrl-C or a closed terminal sets a flag, which is checked where no partial file is left. The
// process ends at once if nothing has looked at it after 0.9 s of processor time.
struct Interrupted : std::exception {
  const char* what() const noexcept override { return "interrupted"; }
};

void catch_interrupts();  // SIGINT, SIGTERM and SIGHUP set the flag
bool is_interrupted();
void forget_interrupt();  // clears the flag
void check_interrupt();   // throws Interrupted if the flag is set

class Progress {
 public:
  static constexpr double kPatience = 2;  // [s]
  explicit Progress(bool quiet, double after = 0);
  ~Progress();
  // `weight`: expected share of the total duration.
  void stage(const std::string& name, double weight);
  void advance(double fraction_of_stage);  // in [0, 1]
  // Of an end, or of equal parts. Throws Interrupted after Ctrl-C.
  void advance(double done, double end) {
    check_interrupt();
    advance(done / end);
  }
  void advance(std::size_t done, std::size_t parts) {
    advance(static_cast<double>(done), static_cast<double>(parts));
  }
  void at(const std::string& name, double share);  // instead of stages: share of the total
  void finish();
  double seconds() const;  // since construction

 private:
  void draw();
  bool terminal_, quiet_;
  double after_;  // [s]
  std::string name_;
  double done_ = 0, weight_ = 0, fraction_ = 0;
  std::chrono::steady_clock::time_point start_, drawn_;
};

// Monotonic time in seconds.
inline double as_seconds(std::chrono::steady_clock::duration time) noexcept {
  return std::chrono::duration<double>(time).count();
}
inline double steady_seconds() noexcept {
  return as_seconds(std::chrono::steady_clock::now().time_since_epoch());
}

}  // namespace twinarm
