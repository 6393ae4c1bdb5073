// A progress bar with the time left, on stderr. Silent where stderr is no terminal, but for one
// line as a stage begins.
#pragma once

#include <chrono>
#include <string>

namespace twinarm {

class Progress {
 public:
  explicit Progress(bool quiet);
  ~Progress();
  // `weight` is the share of the whole that this stage is expected to take.
  void stage(const std::string& name, double weight);
  void advance(double fraction_of_stage);  // in [0, 1], of the current stage
  void finish();

 private:
  void draw();
  bool quiet_, terminal_;
  std::string name_;
  double done_ = 0, weight_ = 0, fraction_ = 0;
  std::chrono::steady_clock::time_point start_, drawn_;
};

}  // namespace twinarm
