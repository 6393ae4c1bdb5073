#include "app/lab/stream/frame_bytes.h"

namespace twinarm {
namespace {

// An operator motion at rest around that time.
DeviceStep at_rest(const OperatorFrame& hand, double t) {
  DeviceMotion motion(1);
  motion.set({hand.q_K, std::vector<double>(hand.q_K.size(), 0.0), hand.gripper_closed}, t - 2, 4);
  return motion.newest();
}

}  // namespace

void LabSnapshots::change(const SimulatePlan& plan) {
  const SceneModel* scene = plan.input.scene.get();
  overridden_ = scene ? std::make_unique<Overridden>(*scene, plan.run.step) : nullptr;
  plan_ = &plan;
}

const std::vector<SceneCoupling>& LabSnapshots::components() const {
  static const std::vector<SceneCoupling> none;
  return overridden_ ? overridden_->scene.couplings : none;
}

void LabSnapshots::set_targets(const LabFrame& frame) {
  if (!overridden_) return;
  const double t = frame.recorded.t;
  overridden_->input.replay_step(std::nullopt);
  if (frame.hand && frame.hand->active) overridden_->input.replay_step(at_rest(*frame.hand, t));
  // A target robot caches its state at the last time; in another branch it may differ.
  if (t == last_time_)
    for (std::size_t c = 0; c < overridden_->couplings.size(); ++c)
      overridden_->couplings.target(c, t + 1);
  last_time_ = t;
}

Snapshot LabSnapshots::at_start() {
  last_time_ = plan_->input.robot.state.x.t;
  return snapshot_of(plan_->input, couplings(), {plan_->input.robot.state.x, {}, {}, {}});
}

Snapshot LabSnapshots::of(const LabFrame& frame) {
  set_targets(frame);
  const Model<double>& model = plan_->input.robot.model;
  Snapshot snapshot = snapshot_of(plan_->input, couplings(), instant_of(frame.recorded, model));
  if (const auto& hand = frame.hand; hand && hand->active) {
    snapshot.devices.clear();
    // Without a device all of its angles are zero.
    if (std::ranges::any_of(hand->theta, [](double angle) { return angle != 0; }))
      snapshot.devices = {{hand->theta, hand->gripper_closed, hand->force_W}};
  }
  if (frame.mouse && frame.mouse->body > 0 && frame.mouse->body < model.body_count()) {
    const MouseSpringState& mouse = *frame.mouse;
    snapshot.mouse_spring = {static_cast<std::size_t>(mouse.body),
                             snapshot.k.position(mouse.body, mouse.p_L), mouse.goal_W,
                             mouse.force_W};
  }
  return snapshot;
}

std::vector<Pose> LabSnapshots::poses(const LabFrame& frame) const {
  const Model<double>& model = plan_->input.robot.model;
  const Kinematics k = kinematics_at(model, instant_of(frame.recorded, model).x);
  return k.X_WL;
}

LabChannels::LabChannels(const SimulateInput& input, const RecordingHeader& header,
                         const std::vector<SceneCoupling>& components)
    : RunChannels(input, header) {
  add_led_joints(input.robot.coordinates, components);
  mouse_ = add("mouse_spring", "N", "mouse_spring", "mouse");
  hand_ = add("device/force", "N", "device", "force");
  for (const char* motor : {"1", "2", "3"})
    add(std::string("device/torque") + motor, "N m", "device", "torque");
  time_ = add("time/step", "s", "time", "step");
  add("time/longest", "s", "time", "step");
  add("time/speed_ratio", "1", "time", "speed_ratio");
  if (input.scene && input.scene->may_touch()) {
    contacts_ = add("contacts/residual", "m/s", "contacts", "residual");
    add("contacts/penetration", "m", "contacts", "penetration");
    add("contacts/asleep", "1", "contacts", "asleep");
  }
}

bool LabChannels::add_pairs(const LabFrame& frame) {
  bool any = false;
  for (const RecordedContact& c : frame.recorded.contacts)
    if (add_pair(c.a, c.b)) any = true;
  return any;
}

void LabChannels::values(const LabFrame& frame, const Snapshot& snapshot, SceneCouplings* couplings,
                         std::vector<double>& values) const {
  RunChannels::values(frame.recorded, snapshot, couplings, values);
  if (frame.mouse) values[mouse_] = frame.mouse->force_W.norm();
  if (frame.hand) {
    values[hand_] = frame.hand->force_W.norm();
    for (std::size_t i = 0; i < 3; ++i) values[hand_ + 1 + i] = frame.hand->torque[i];
  }
  values[time_] = frame.step_time;
  values[time_ + 1] = frame.longest_step;
  values[time_ + 2] = frame.pace;
  if (contacts_ == 0) return;
  values[contacts_] = frame.residual;
  values[contacts_ + 1] = 0;
  for (const RecordedContact& c : frame.recorded.contacts)
    values[contacts_ + 1] = std::max(values[contacts_ + 1], c.depth);
  values[contacts_ + 2] = frame.asleep;
}

}  // namespace twinarm
