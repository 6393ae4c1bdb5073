// The hand's part of a tick: before the step the device moves the kinematic robot, after it the
// couplings' reaction goes back to the device's motors.
//
//   device.poll -> watch, mapping -> target of the KVR
//   ... one step of the DVR ...
//   reaction of the couplings -> force -> device.render
//
// Neither half waits, throws or allocates.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/scene/forces/scene_couplings.h"
#include "app/scene/model/scene_model.h"
#include "coupling/device/device_watchdog.h"
#include "coupling/device/force_feedback.h"
#include "coupling/device/input_device.h"
#include "solver/stepping/simulation.h"

namespace twinarm {

struct HandLoopOptions {
  MappingSpec mapping;
  HandForceSpec force;
};

class HandLoop {
 public:
  // `led`: the couplings (SceneModel::couplings) whose kinematic side the hand moves, all of them
  // by the same joints; the first one leads. All must outlive it. Throws InputError: a mapping that
  // cannot move these joints.
  HandLoop(const SceneModel& scene, const SceneCouplings& couplings,
           const std::vector<std::size_t>& led, HandDevice& device, const HandLoopOptions& options);

  // The KVR's driven joints stand at q: from there the device moves it. `now`: the device's time.
  void begin(const std::vector<double>& q, double now) noexcept;
  // For the step [t, t + h] from x: where the KVR is to be at its start, and how it moves on.
  const HandTarget& before_step(const State<double>& x, double now, double h) noexcept;
  // What the hand feels of the step that ended where the simulation stands; `finite`: false where
  // that is nowhere, and nothing is felt.
  const DeviceForce& after_step(const Simulation& simulation, double h, bool finite) noexcept;

  const HandTarget& target() const { return target_; }
  const std::vector<double>& q_D() const { return q_D_; }  // of the DVR, at the start of the step
  const DeviceState& device() const { return state_; }     // as it was polled last
  const DeviceForce& felt() const { return felt_; }
  const DeviceWatchdog& watch() const { return watch_; }
  const DeviceMapping& mapping() const { return *mapping_; }

 private:
  const Model<double>& model_;
  const SceneCouplings& couplings_;
  HandDevice& device_;
  std::size_t leader_;
  std::vector<int> turned_;
  std::unique_ptr<DeviceMapping> mapping_;
  CouplingReaction reaction_;
  std::unique_ptr<HandForce> force_;
  DeviceWatchdog watch_;
  HandTarget target_;
  std::vector<double> q_D_;
  DeviceState state_;
  DeviceForce felt_;
};

// Bodies that the driven joints carry.
std::vector<int> turned_bodies(const SceneModel& scene, const DrivenJoints& joints);
// The point that follows the stylus: where the outermost spring of these couplings pulls, else the
// last driven link's origin. Link axes.
std::pair<int, Vector3> led_point(const SceneModel& scene, const std::vector<std::size_t>& led);

// The clock of a servo thread: absolute deadlines, a period apart, so that no lateness adds up.
//
// What a thread may do for its punctuality: SCHED_FIFO and memory that is never paged out. Both
// need a privilege (CAP_SYS_NICE, or limits in /etc/security/limits.conf); without it everything
// works, later at times.
class ServoClock {
 public:
  // Periods that the thread may be late by and still make up for, one tick at once after another.
  // Beyond it the deadlines begin anew from now: time has slipped.
  static constexpr int kMaxBehind = 100;

  explicit ServoClock(double period);  // [s]
  // The first deadline is a period from now.
  void start() noexcept;
  struct Wake {
    double late = 0;  // after the deadline [s]
    int slipped = 0;  // periods that were given up
  };
  // Sleeps until the next deadline; returns at once where that has passed.
  Wake wait() noexcept;
  // Whether the next deadline has passed already: the tick took longer than there was.
  bool is_behind() const noexcept;

 private:
  std::int64_t period_, deadline_ = 0;  // [ns], of CLOCK_MONOTONIC
};

double monotonic_time() noexcept;   // [s]
double thread_cpu_time() noexcept;  // of the calling thread [s]

// Asks for SCHED_FIFO for the calling thread, and locks the memory of the program. What was not
// granted, with the remedy; empty where both were.
std::string ask_for_real_time();

}  // namespace twinarm
