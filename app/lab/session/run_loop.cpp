#include "app/lab/session/run_loop.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/servo/servo_clock.h"

namespace twinarm {
namespace {

constexpr auto kMaxBurst = std::chrono::microseconds(4000);  // between two looks at commands
constexpr double kMaxCatchUp = 0.05;  // what is further behind is not made up for [s]

}  // namespace

void RunLoop::begin(std::unique_ptr<LabRun> run, LabLanes lanes) {
  run_ = std::move(run);
  lanes_ = std::move(lanes);
}

LabFrame RunLoop::frame() {
  LabFrame frame = run_->frame(names_);
  lanes_.add_to(frame, names_);
  return frame;
}

bool RunLoop::take_steps(const std::function<void()>& after) {
  const Clock::time_point begin = Clock::now();
  const double due = has_single_steps() ? HUGE_VAL : pace_.due(begin);
  const double h = run_->step_length();
  while (run_->time() + 0.5 * h < due) {
    const double cpu = thread_cpu_time();
    if (!take_step()) return false;
    const double taken = thread_cpu_time() - cpu;
    cpu_ += taken;
    longest_cpu_ = std::max(longest_cpu_, taken);
    ++steps_;
    after();
    if (steps_left_ > 0 && --steps_left_ == 0) return true;
    if (Clock::now() - begin > kMaxBurst) break;
  }
  pace_.forgive(Clock::now(), run_->time(), kMaxCatchUp);
  return true;
}

bool RunLoop::take_step() {
  bool goes_on = false;
  if (repeats_) {
    const Timeline::Known known = timeline_.known_input(run_->step_count() + 1);
    repeats_ = known.goes_on;
    goes_on = run_->step(known.input);
  } else {
    goes_on = run_->step();
  }
  if (!goes_on) return false;
  lanes_.follow(*run_);
  const LabInput& input = run_->input();
  if (input.hand || input.pull) timeline_.add(input);
  return true;
}

RunLoop::Cost RunLoop::take_cost() {
  const Cost cost{steps_ > 0 ? cpu_ / static_cast<double>(steps_) : 0, longest_cpu_};
  cpu_ = longest_cpu_ = 0;
  steps_ = 0;
  return cost;
}

}  // namespace twinarm
