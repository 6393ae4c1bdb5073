// Steps the run and its variants by wall time. In a branch it repeats the earlier inputs while they
// are known. Used by the run's thread.
#pragma once

#include "app/lab/session/scene_builder_thread.h"
#include "app/support/progress.h"

namespace twinarm {

// History of the session's run, the part of it that the last branch left, and the scene that a
// recording needs. Thread-safe; calls take no longer than copying pointers.
class Timeline {
 public:
  using Frame = LabHistory::Frame;
  explicit Timeline(std::size_t max_bytes) : history_(max_bytes), before_(max_bytes) {}

  // Begins another run; driven: InputOverride::couplings().
  void begin(std::shared_ptr<const BuildResult> scene, std::vector<std::size_t> driven);
  void add(LabFrame frame, const LabNames& names);
  void add(const LabInput& input);
  void clear();
  // Begins a branch at t; returns its first frame, null if t is no longer in the history.
  Frame branch(double t);

  // The frame at t, or the oldest, and the inputs of the steps after it.
  std::pair<Frame, std::vector<LabInput>> since(double t) const;

  // Input at t of the run that was left; nothing: that run did not reach t.
  std::optional<LabInput> known_input(double t) const;

  // The newest frame, or that at t; `before`: at the same time in the run that was left.
  struct View {
    std::shared_ptr<const BuildResult> scene;
    double first = 0, last = 0;  // range of the history [s]
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
  std::vector<std::size_t> driven_;
};

// Run time against wall time.
class RealTimePacer {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // From now on `speed` seconds of run time per second of wall time.
  void begin(Time wall, double run, double speed) {
    wall_ = measured_wall_ = wall;
    run_ = measured_run_ = run;
    speed_ = speed;
  }
  // Run time that is due [s].
  double due(Time wall) const { return run_ + speed_ * as_seconds(wall - wall_); }
  // Gives up a delay of more than `max` [s of wall time].
  void limit_backlog(Time wall, double run, double max) {
    const double behind = due(wall) - run;
    if (behind > speed_ * max) run_ -= behind - speed_ * max;
  }
  // Achieved share of the speed in the last full second.
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

  void begin(std::unique_ptr<LabRun> run, LabVariants variants);
  LabRun& run() { return *run_; }
  LabNames& names() { return names_; }
  LabFrame frame();  // of the run and its variants
  std::vector<std::string> take_warnings() { return variants_.take_warnings(); }

  void set_pace(double speed) { pace_.begin(Clock::now(), run_->view().time(), speed); }
  double pace_factor() { return pace_.factor(Clock::now(), run_->view().time()); }
  void request_steps(long count) { steps_left_ = count; }
  bool has_single_steps() const { return steps_left_ > 0; }
  // Whether steps repeat the inputs of the run that was left, while they are known.
  void repeat_inputs(bool on) { repeats_ = on; }
  // Takes the requested single steps, or those that are due, for at most kMaxBurst; calls `after`
  // after each. False: the run has stopped.
  bool take_steps(const std::function<void()>& after);

  // Mean and longest processor time of a step since the last call [s].
  std::pair<double, double> take_cost();

 private:
  bool take_step();

  Timeline& timeline_;
  std::unique_ptr<LabRun> run_;
  LabVariants variants_;
  LabNames names_;
  RealTimePacer pace_;
  long steps_left_ = 0;
  bool repeats_ = false;
  double cpu_ = 0, longest_cpu_ = 0;  // [s]
  long steps_ = 0;                    // that took cpu_
};

}  // namespace twinarm
