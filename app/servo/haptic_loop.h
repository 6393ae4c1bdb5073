// Haptic loop: one tick moves the target robot (KVR) by the device before a step of the robot
// (DVR), and renders the couplings' reaction after it.
//
//   device.poll -> watchdog, mapping -> target of the KVR
//   ... one step of the DVR ...
//   reaction of the couplings -> force -> device.render
//
// Neither half blocks, throws or allocates.
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

// Operator motion that is stored for couplings with a delay, of at most kMaxDelay [s].
inline constexpr double kMaxDelay = 2;

struct HapticLoopOptions {
  MappingSpec mapping;
  ForceFeedbackSpec force;
};

class HapticLoop {
 public:
  // `driven`: indices of SceneModel::couplings whose targets the device moves, all by the same
  // joints. All arguments must outlive it. Throws InputError: the mapping cannot move these joints.
  HapticLoop(const SceneModel& scene, const SceneCouplings& couplings,
             const std::vector<std::size_t>& driven, InputDevice& device,
             const HapticLoopOptions& options);

  // The device moves the KVR from joint positions q on. `now`: time of the device.
  void begin(const std::vector<double>& q, double now) noexcept;
  // For the step [t, t + h] from x: q and qd of the KVR's driven joints at its start.
  const MappedTarget& before_step(const State<double>& x, double now, double h) noexcept;
  // Force for the step that led to the simulation's state; zero if that is not `finite`.
  const DeviceForce& after_step(const Simulation& simulation, double h, bool finite) noexcept;

  const MappedTarget& target() const { return target_; }
  const std::vector<double>& q_D() const { return q_D_; }  // of the DVR at the start of the step
  const DeviceState& device() const { return state_; }     // polled last
  const DeviceForce& force() const { return rendered_; }
  const DeviceWatchdog& watch() const { return watch_; }
  const DeviceMapping& mapping() const { return *mapping_; }

 private:
  const Model<double>& model_;
  const SceneCouplings& couplings_;
  InputDevice& device_;
  std::size_t first_;  // driven coupling
  std::vector<int> driven_;
  std::unique_ptr<DeviceMapping> mapping_;
  CouplingReaction reaction_;
  std::unique_ptr<ForceFeedback> force_;
  DeviceWatchdog watch_;
  MappedTarget target_;
  std::vector<double> q_D_;
  DeviceState state_;
  DeviceForce rendered_;
};

std::vector<int> driven_bodies(const SceneModel& scene, const DrivenJoints& joints);
// Point that follows the stylus: of the outermost linear coupling of these, else the origin of the
// last driven link, or its centre of mass if it has no child. Link axes.
std::pair<int, Vector3> controlled_point(const SceneModel& scene,
                                         const std::vector<std::size_t>& driven);

// Clock of a servo thread with absolute deadlines, so that delays do not accumulate.
class ServoClock {
 public:
  // Delay in periods that is made up for by ticks without a wait. Beyond it periods are skipped.
  static constexpr int kMaxBehind = 100;

  explicit ServoClock(double period);  // [s]
  // The first deadline is one period from now.
  void start() noexcept;
  struct Wake {
    double late = 0;  // after the deadline [s]
    int slipped = 0;  // skipped periods
  };
  // Sleeps until the next deadline; returns at once if it has passed.
  Wake wait() noexcept;
  // Whether the next deadline has passed: a deadline miss.
  bool is_behind() const noexcept;

 private:
  std::int64_t period_, deadline_ = 0;  // [ns], of CLOCK_MONOTONIC
};

double monotonic_time() noexcept;   // [s]
double thread_cpu_time() noexcept;  // of the calling thread [s]

// Requests SCHED_FIFO for the calling thread, and locks the program's memory; both need a privilege
// (CAP_SYS_NICE, or limits in /etc/security/limits.conf). Returns what was denied and the remedy.
std::string request_real_time();

}  // namespace twinarm
