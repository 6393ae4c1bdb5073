// A progress bar with the time left, on stderr. Silent where stderr is no terminal, but for one
// line as a stage begins.
//
// With `after`: for those who have waited for so long; before, and without a terminal, silent.
#pragma once

#include <chrono>
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

}  // namespace twinarm
