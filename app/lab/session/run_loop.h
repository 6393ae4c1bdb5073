// The run and its variants, stepped by wall time in bursts, by the hand as it is then; in a branch,
// as long as it is known, by what the hand did then. Of the run's thread.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "app/lab/run/history.h"
#include "app/lab/run/lab_run.h"
#include "app/lab/run/variants.h"
#include "app/lab/session/scene_builder_thread.h"
#include "app/support/progress.h"

namespace twinarm {

// What is remembered of the session's run: its history, what came after the instant at which the
// last branch began, and the scene that a recording of it needs. Any thread; no call takes longer
// than copying pointers.
class Timeline {
 public:
  using Frame = LabHistory::Frame;
  explicit Timeline(std::size_t max_bytes) : history_(max_bytes), before_(max_bytes) {}

  // From now on it is another run; led: LabRun::led().
  void begin(std::shared_ptr<const BuildResult> scene, std::vector<std::size_t> led);
  void add(LabFrame frame, const LabNames& names);
  void add(const LabInput& input);
  void forget();
  // Back to an instant, where a branch begins. Null: it is no longer remembered.
  Frame branch(double t);

  // What came from outside in a step of the branch that was left, and whether more is known.
  struct Known {
    LabInput input;
    bool goes_on = false;
  };
  Known known_input(long step) const;

  // The newest instant, or that at t; `before`: the same time in the branch that was left.
  struct View {
    std::shared_ptr<const BuildResult> scene;
    double first = 0, last = 0;  // that are remembered [s]
    Frame frame, before;
  };
  View view(std::optional<double> t) const;
  std::vector<Frame> frames(double from) const;
  std::shared_ptr<const BuildResult> scene() const;
  void save(const std::filesystem::path& file) const;  // throws InputError

 private:
  mutable std::mutex mutex_;
  LabHistory history_, before_;
  std::shared_ptr<const BuildResult> scene_;
  LabNames names_;
  std::vector<std::size_t> led_;
};

// Run time against wall time: how far the run is to be, and how well it keeps up.
class RealTimePacer {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // From now on, at so many seconds of run time in one of wall time.
  void begin(Time wall, double run, double speed) {
    wall_ = measured_wall_ = wall;
    run_ = measured_run_ = run;
    speed_ = speed;
  }
  // Where the run is to be [s].
  double due(Time wall) const { return run_ + speed_ * as_seconds(wall - wall_); }
  // What is further behind than that is not made up for [s of wall time].
  void forgive(Time wall, double run, double most) {
    const double behind = due(wall) - run;
    if (behind > speed_ * most) run_ -= behind - speed_ * most;
  }
  // Run time over what was asked for, of the last second; 1: it keeps up.
  double factor(Time wall, double run) {
    const double passed = as_seconds(wall - measured_wall_);
    if (passed >= 1) {
      factor_ = (run - measured_run_) / (speed_ * passed);
      measured_wall_ = wall;
      measured_run_ = run;
    }
    return factor_;
  }

 private:
  Time wall_{}, measured_wall_{};
  double run_ = 0, measured_run_ = 0, speed_ = 1, factor_ = 1;
};

class RunLoop {
 public:
  using Clock = std::chrono::steady_clock;
  explicit RunLoop(Timeline& timeline) : timeline_(timeline) {}

  // From now on this run, which goes on from `from` (null: from the scene's start).
  void begin(std::unique_ptr<LabRun> run, LabVariants lanes);
  LabRun& run() { return *run_; }
  LabNames& names() { return names_; }
  LabFrame frame();  // of the run and its variants
  std::vector<std::string> take_warnings() { return lanes_.take_words(); }

  void set_pace(double speed) { pace_.begin(Clock::now(), run_->time(), speed); }
  double pace_factor() { return pace_.factor(Clock::now(), run_->time()); }
  void step_once(long times) { steps_left_ = times; }
  bool has_single_steps() const { return steps_left_ > 0; }
  // The inputs of the branch that was left come again, while they are known, or no longer.
  void repeat_inputs(bool on) { repeats_ = on; }
  // The single steps, or those that are due, but no longer than a burst; `after` is called after
  // each. False: the run goes on no more.
  bool take_steps(const std::function<void()>& after);

  struct Cost {                    // processor time since this was asked last [s]
    double mean = 0, longest = 0;  // of a step
  };
  Cost take_cost();

 private:
  bool take_step();

  Timeline& timeline_;
  std::unique_ptr<LabRun> run_;
  LabVariants lanes_;
  LabNames names_;
  RealTimePacer pace_;
  long steps_left_ = 0;
  bool repeats_ = false;
  double cpu_ = 0, longest_cpu_ = 0;  // [s]
  long steps_ = 0;                    // that took cpu_
};

}  // namespace twinarm
