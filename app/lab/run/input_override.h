// How a hand leads the kinematic robot of one run: in place of the scene's own hand, from step to
// step, never with a jump.
//
// The pulls that are led are those of one kinematic robot: of the first that follows a device, else
// of the first that follows any hand, else of the first. In each step the robot is told q and qd
// for the step's start (coupling/device/device_motion.h); what is told is all that the step needs
// to be taken again.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/lab/run/history.h"
#include "app/lab/run/lab_inputs.h"
#include "app/servo/haptic_loop.h"
#include "coupling/device/device_motion.h"

namespace twinarm {

// A hand in whose place another leads at times.
class ReplacedHand final : public OperatorMotion {
 public:
  // Null: its own.
  using Instead = std::function<const OperatorMotion*(double t, double toward)>;
  ReplacedHand(std::unique_ptr<OperatorMotion> own, Instead instead)
      : own_(std::move(own)), instead_(std::move(instead)) {}
  HandSample sample(double t, double toward) const override {
    const OperatorMotion* other = instead_(t, toward);
    return (other ? *other : *own_).sample(t, toward);
  }
  double duration() const override { return own_->duration(); }
  std::string description() const override { return own_->description(); }

 private:
  std::unique_ptr<OperatorMotion> own_;
  Instead instead_;
};

class InputOverride {
 public:
  // Chooses the pulls; those whose target stands still get joints that a hand can turn. Before the
  // couplings are made, with in_place(). All must outlive this. The scene may be null.
  InputOverride(SceneModel* scene, LabHand& hand, double h);
  HandInPlace in_place();
  void attach(SceneCouplings& couplings) { couplings_ = &couplings; }
  // The robot stands where that frame left it.
  void go_on_from(const LabHandFrame& frame);
  // And until the next step, for who asks: as the step of h had it that ended there, at t.
  void stand_as(const LabHandFrame& frame, double t, double h);

  // For the step [t, t + h] from x: what the robot is told; nothing where the scene leads. Throws
  // InputError where the hand's mapping cannot move these joints.
  std::optional<HandStep> before_step(const State<double>& x, double t, double h);
  // The same again.
  void take_again(const std::optional<HandStep>& told);
  void after_step(const Simulation& simulation, double h, bool finite) noexcept;

  std::optional<LabHandFrame> frame(double t) const;
  const std::vector<int>& driven() const { return turned_; }
  const std::vector<double>& q() const { return target_.q; }
  std::optional<std::pair<int, Vector3>> tip() const;
  // That are led, by their places in SceneDescription::couplings.
  std::vector<std::size_t> couplings() const;
  bool leads() const { return leads_; }

 private:
  void choose_pulls();
  const OperatorMotion* source_at(double t, double toward) const;
  std::vector<double> own_q(double t, double toward) const;
  void take_over(double t, double h);
  void make_loop(double h);
  void move_towards(const std::vector<double>& goal, double h);
  void follow_tip();
  void ask_elsewhere(double t);

  SceneModel* scene_;
  LabHand& hand_;
  SceneCouplings* couplings_ = nullptr;
  std::vector<std::size_t> led_;
  std::vector<int> turned_;
  const OperatorMotion* own_ = nullptr;  // of the first that is led
  DeviceMotion live_, first_;            // what was told of late, and when this lead began
  HandTarget target_;
  std::unique_ptr<HandLoop> loop_;
  unsigned long made_for_ = 0;  // of LabHand::chosen()
  bool leads_ = false, is_live_ = false, goes_on_ = false, is_fresh_ = false;
  bool stands_ = false;  // as a frame has it: not led by a step yet
};

}  // namespace twinarm
