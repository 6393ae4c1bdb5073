// Lets the operator's input (lab_inputs.h) replace the scene's own motion of a target robot, from
// step to step and without a jump.
//
// The driven couplings are those of one target robot: of the first whose target is "device", else
// of the first with any operator motion, else of the first. Before each step q and qd of the driven
// joints are set for its start (coupling/device/device_motion.h); these values are sufficient to
// repeat the step.
#pragma once

#include "app/lab/run/lab_inputs.h"
#include "app/servo/haptic_loop.h"

namespace twinarm {

class InputOverride {
 public:
  // Selects the driven couplings, and adds driven joints to couplings whose target is fixed. To be
  // made before the couplings, which take in_place(). All arguments must outlive it; scene may be
  // null.
  InputOverride(SceneModel* scene, OperatorInput& input, double h);
  MotionReplacement in_place();
  void attach(SceneCouplings& couplings) { couplings_ = &couplings; }
  // The next step begins with the target robot as in that frame.
  void continue_from(const OperatorFrame& frame);
  // Until the next step the target moves as at the end of the step [t - h, t] of that frame.
  void restore(const OperatorFrame& frame, double t, double h);

  // For the step [t, t + h] from x: motion of the driven joints; none: the scene's own. Throws
  // InputError: the device's mapping cannot move these joints.
  std::optional<DeviceStep> before_step(const State<double>& x, double t, double h);
  void replay_step(const std::optional<DeviceStep>& motion);
  void after_step(const Simulation& simulation, double h, bool finite) noexcept {
    if (loop_ && is_live_ && active_) loop_->after_step(simulation, h, finite);
  }

  std::optional<OperatorFrame> frame(double t) const;
  // Bodies of the driven joints and the joints' targets; empty: no coupling can be driven.
  const std::vector<int>& driven() const { return driven_; }
  const std::vector<double>& q() const { return target_.q; }
  std::optional<std::pair<int, Vector3>> tip() const;  // point moved by the stylus, link axes
  std::vector<std::size_t> couplings()
      const;  // driven ones, indices of SceneDescription::couplings
  // Also true while the target returns to the scene's motion.
  bool is_active() const { return active_; }

 private:
  void select_couplings();
  const OperatorMotion* substitute_at(double t, double toward) const;
  std::vector<double> own_q(double t, double toward) const;
  void make_loop(double h);
  void move_towards(const std::vector<double>& goal, double h);
  // A target robot caches its state of the last time that was evaluated. The cached state at t is
  // wrong after the motion was replaced; evaluating another time removes it.
  void invalidate_targets(double t) {
    for (const std::size_t coupling : coupled_) couplings_->target(coupling, t - 1);
  }
  void end_restored() {
    if (std::exchange(is_restored_, false)) active_ = false;
  }

  SceneModel* scene_;
  OperatorInput& input_;
  SceneCouplings* couplings_ = nullptr;
  std::vector<std::size_t> coupled_;  // driven couplings: indices of SceneModel::couplings
  std::vector<int> driven_;
  const OperatorMotion* own_ = nullptr;  // of the first driven coupling
  DeviceMotion live_, first_;            // recent motion; its first step since the take-over
  MappedTarget target_;
  std::unique_ptr<HapticLoop> loop_;
  unsigned long loop_revision_ = 0;  // OperatorInput::revision() of loop_
  bool active_ = false, is_live_ = false, continues_ = false, is_fresh_ = false;
  bool is_restored_ = false;
};

}  // namespace twinarm
