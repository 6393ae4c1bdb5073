#include "app/lab/run/input_override.h"

namespace twinarm {
namespace {

// Priority of a coupling's target: input device, other operator motion, fixed.
int rank_of_target(const SceneCoupling& coupling) {
  if (coupling.target.kind == CouplingTarget::Kind::device) return 2;
  return coupling.driven.turned.empty() ? 0 : 1;
}

}  // namespace

InputOverride::InputOverride(SceneModel* scene, OperatorInput& input, double h)
    : scene_(scene), input_(input), live_(stored_steps(kMaxDelay, h) + 2), first_(1) {
  if (scene_) select_couplings();
}

void InputOverride::select_couplings() {
  std::vector<SceneCoupling>& all = scene_->couplings;
  const SceneCoupling* best = nullptr;
  for (const SceneCoupling& c : all)
    if (c.is_first_component() && !c.soft_limits && c.speed == 1 &&
        (!best || rank_of_target(c) > rank_of_target(*best)))
      best = &c;
  if (!best) return;
  if (best->driven.turned.empty()) {
    const std::vector<std::string> joints = turned_joints(*scene_, best->robot);
    for (SceneCoupling& c : all)
      if (c.robot == best->robot && !c.soft_limits && c.driven.turned.empty())
        c.driven.turned = joints;
  }
  if (best->driven.turned.empty()) return;
  for (std::size_t c = 0; c < all.size(); ++c)
    if (all[c].has_motion_of(*best) && all[c].driven.turned == best->driven.turned)
      coupled_.push_back(c);
  driven_ = driven_bodies(*scene_, best->driven);
  target_.q.assign(driven_.size(), 0);
  target_.qd.assign(driven_.size(), 0);
}

MotionReplacement InputOverride::in_place() {
  return [this](std::size_t coupling,
                std::unique_ptr<OperatorMotion> own) -> std::unique_ptr<OperatorMotion> {
    if (std::ranges::find(coupled_, coupling) == coupled_.end()) return own;
    if (coupling == coupled_.front()) own_ = own.get();
    const auto substitute = [this](double t, double toward) { return substitute_at(t, toward); };
    return std::make_unique<OverridableMotion>(std::move(own), substitute);
  };
}

// Null: the scene's own motion, while inactive and before the take-over.
const OperatorMotion* InputOverride::substitute_at(double t, double toward) const {
  double inside = t + 1e-9 * (toward - t);
  if (inside == t) inside = std::nextafter(t, toward);
  if (!active_ || inside < first_.newest().t) return nullptr;
  return inside <= first_.duration() ? &first_ : &live_;
}

void InputOverride::continue_from(const OperatorFrame& frame) {
  if (!frame.active || frame.q_K.size() != target_.q.size()) return;
  target_.q = frame.q_K;
  target_.gripper_closed = frame.gripper_closed;
  continues_ = true;
}

void InputOverride::restore(const OperatorFrame& frame, double t, double h) {
  if (!frame.active || frame.q_K.size() != target_.q.size()) return;
  target_ = {frame.q_K, frame.qd_K, frame.gripper_closed};
  live_.set(target_, t - h, h);
  first_.set(live_.newest());
  active_ = is_restored_ = true;
  invalidate_targets(t);
}

std::vector<double> InputOverride::own_q(double t, double toward) const {
  const OperatorSample sample = own_->sample(t, toward);
  std::vector<double> q;
  for (std::size_t j = 0; j < driven_.size(); ++j)
    q.push_back(OperatorMapping{}.robot_angle(sample, j));
  return q;
}

void InputOverride::make_loop(double h) {
  loop_revision_ = input_.revision();
  is_live_ = true;
  loop_.reset();
  if (!input_.device()) return;
  loop_ = std::make_unique<HapticLoop>(*scene_, *couplings_, coupled_, *input_.device(),
                                       HapticLoopOptions{input_.mapping(), input_.force()});
  loop_->begin(target_.q, input_.tick(h));
  is_fresh_ = true;
}

// At most OperatorInput::kMaxJointSpeed.
void InputOverride::move_towards(const std::vector<double>& goal, double h) {
  const double max_change = OperatorInput::kMaxJointSpeed * h;
  for (std::size_t j = 0; j < target_.q.size(); ++j) {
    const double before = target_.q[j], change = goal[j] - before;
    target_.q[j] =
        std::abs(change) <= max_change ? goal[j] : before + std::copysign(max_change, change);
    target_.qd[j] = (target_.q[j] - before) / h;
  }
}

std::optional<DeviceStep> InputOverride::before_step(const State<double>& x, double t, double h) {
  if (coupled_.empty()) return std::nullopt;
  const OperatorInput::Source source = input_.source();
  end_restored();
  if (!active_ && !continues_ && source == OperatorInput::Source::scene) return std::nullopt;
  const bool begins = !active_;
  if (begins) {
    if (!std::exchange(continues_, false)) {
      target_.q = own_q(t, t + h);
      target_.gripper_closed = own_->sample(t, t + h).button;
    }
    std::ranges::fill(target_.qd, 0.0);
    invalidate_targets(t);
  }
  if (!is_live_ || loop_revision_ != input_.revision()) make_loop(h);
  std::vector<double> goal = target_.q;
  if (source == OperatorInput::Source::scene) {
    goal = own_q(t, t + h);
    move_towards(goal, h);
    if (target_.q == goal) {
      active_ = false;
      invalidate_targets(t);
      return std::nullopt;
    }
  } else if (loop_) {
    if (input_.gestures() && input_.tip_goal())
      if (const auto stylus = loop_->mapping().stylus_for(*input_.tip_goal()))
        input_.gestures()->place(*stylus);
    // First with the device as it was at the take-over, so that the target does not move.
    target_ = loop_->before_step(x, input_.tick(is_fresh_ ? 0 : h), h);
    is_fresh_ = false;
  } else {
    const auto& goals = input_.joint_goals();
    for (std::size_t j = 0; j < std::min(goal.size(), goals.size()); ++j)
      goal[j] = goals[j].value_or(goal[j]);
    move_towards(goal, h);
    target_.gripper_closed = input_.gripper_closed();
  }
  live_.set(target_, t, h);
  if (begins) first_.set(live_.newest());
  active_ = true;
  return live_.newest();
}

void InputOverride::replay_step(const std::optional<DeviceStep>& motion) {
  is_live_ = continues_ = false;
  end_restored();
  if (!motion || coupled_.empty()) {
    active_ = false;
    return;
  }
  if (!active_) invalidate_targets(motion->t);
  live_.set(*motion);
  if (!active_) first_.set(*motion);
  active_ = true;
  for (std::size_t j = 0; j < target_.q.size(); ++j) {
    target_.q[j] = OperatorMapping{}.robot_angle(motion->sample, j);
    target_.qd[j] = OperatorMapping{}.robot_rate(motion->sample, j);
  }
  target_.gripper_closed = motion->sample.button;
}

std::optional<OperatorFrame> InputOverride::frame(double t) const {
  if (coupled_.empty()) return std::nullopt;
  OperatorFrame frame;
  frame.active = active_ || continues_;
  frame.q_K = frame.active ? target_.q : own_q(t, t - 1e-6);
  frame.qd_K.assign(driven_.size(), 0.0);
  if (frame.active) frame.qd_K = target_.qd;
  frame.gripper_closed = frame.active ? target_.gripper_closed : own_->sample(t, t - 1e-6).button;
  // A device chosen since the last step has not moved anything yet.
  if (!loop_ || !is_live_ || loop_revision_ != input_.revision()) return frame;
  const OmniParameters& parameters = input_.device()->parameters();
  frame.theta = loop_->device().theta;
  frame.torque = loop_->force().torque;
  frame.force_W = world_from_device(omni_force(parameters, frame.theta, frame.torque));
  frame.mode = static_cast<int>(loop_->watch().mode());
  return frame;
}

std::vector<std::size_t> InputOverride::couplings() const {
  std::vector<std::size_t> indices;
  if (coupled_.empty()) return indices;
  const std::vector<CouplingDescription>& all = scene_->description.couplings;
  for (std::size_t index = 0; index < all.size(); ++index)
    for (const std::size_t c : coupled_)
      if (scene_->couplings[c].coupling == all[index].name &&
          scene_->couplings[c].is_first_component())
        indices.push_back(index);
  return indices;
}

std::optional<std::pair<int, Vector3>> InputOverride::tip() const {
  if (coupled_.empty()) return std::nullopt;
  return controlled_point(*scene_, coupled_);
}

}  // namespace twinarm
