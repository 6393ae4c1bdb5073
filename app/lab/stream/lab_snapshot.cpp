#include "app/lab/stream/lab_snapshot.h"

#include <algorithm>

#include "app/film/filmed_run.h"
#include "app/lab/run/input_override.h"

namespace twinarm {
namespace {

// A hand that stood there all around that time.
HandStep set_pose(const LabHandFrame& hand, double t) {
  DeviceMotion told(1);
  told.set({hand.q_K, std::vector<double>(hand.q_K.size(), 0.0), hand.gripper_closed}, t - 2, 4);
  return told.newest();
}

bool is_at_zero(const LabHandFrame& hand) {
  return std::all_of(hand.theta.begin(), hand.theta.end(), [](double angle) { return angle == 0; });
}

}  // namespace

// The scene's couplings, with a lead in place as in the run; but nobody steps it.
struct LabMoments::OverriddenSource {
  OverriddenSource(const SceneModel& of, double h)
      : scene(of), lead(&scene, nobody, h), couplings(scene, h, nullptr, lead.in_place()) {
    lead.attach(couplings);
  }
  SceneModel scene;
  LabHand nobody;
  InputOverride lead;
  SceneCouplings couplings;
};

LabMoments::LabMoments(const SimulatePlan& plan) {
  change(plan);
}

LabMoments::~LabMoments() = default;

void LabMoments::change(const SimulatePlan& plan) {
  const SceneModel* scene = plan.input.scene.get();
  led_ = scene ? std::make_unique<OverriddenSource>(*scene, plan.run.step) : nullptr;
  plan_ = &plan;
}

SceneCouplings* LabMoments::couplings() {
  return led_ ? &led_->couplings : nullptr;
}

const std::vector<SceneCoupling>& LabMoments::pulls() const {
  static const std::vector<SceneCoupling> none;
  return led_ ? led_->scene.couplings : none;
}

std::vector<int> LabMoments::driven() const {
  return led_ ? led_->lead.driven() : std::vector<int>{};
}

std::optional<std::pair<int, Vector3>> LabMoments::tip() const {
  return led_ ? led_->lead.tip() : std::nullopt;
}

bool LabMoments::follows_device() const {
  return std::any_of(pulls().begin(), pulls().end(), [](const SceneCoupling& c) {
    return c.target == CouplingTarget::Kind::device;
  });
}

void LabMoments::tell(const LabFrame& frame) {
  if (!led_) return;
  led_->lead.take_again(std::nullopt);
  const double t = frame.recorded.t;
  if (frame.hand && frame.hand->leads) led_->lead.take_again(set_pose(*frame.hand, t));
  // A kinematic robot does not look again at an instant that it has seen; but the hand may have
  // been elsewhere, in another branch.
  if (t == last_time_)
    for (std::size_t c = 0; c < led_->couplings.size(); ++c) led_->couplings.target(c, t + 1);
  last_time_ = t;
}

Snapshot LabMoments::at_start() {
  last_time_ = plan_->input.robot.state.x.t;
  return moment_of(plan_->input, couplings(), {plan_->input.robot.state.x, {}, {}});
}

Snapshot LabMoments::of(const LabFrame& frame) {
  tell(frame);
  const Model<double>& model = plan_->input.robot.model;
  Snapshot moment = moment_of(plan_->input, couplings(), instant_of(frame.recorded, model));
  if (const auto& hand = frame.hand; hand && hand->leads) {
    moment.hands.clear();
    // Without a device all of its angles are zero.
    if (!is_at_zero(*hand)) moment.hands = {{hand->theta, hand->gripper_closed, hand->force_W}};
  }
  if (frame.pull && frame.pull->body > 0 && frame.pull->body < model.body_count()) {
    const MousePoint& pull = *frame.pull;
    moment.grip = {static_cast<std::size_t>(pull.body), moment.k.position(pull.body, pull.p_L),
                   pull.goal_W, pull.force_W};
  }
  return moment;
}

std::vector<Pose> LabMoments::places(const LabFrame& frame) const {
  const Model<double>& model = plan_->input.robot.model;
  Kinematics k(model);
  forward_kinematics(model, instant_of(frame.recorded, model).x, k);
  return k.X_WL;
}

LabChannels::LabChannels(const SimulateInput& input, const RecordingHeader& header,
                         const std::vector<SceneCoupling>& led)
    : channels_(input, header) {
  channels_.add_led_joints(input.robot.coordinates, led);
  pull_ = channels_.add("pull", "N", "pull", "mouse");
  hand_ = channels_.add("hand/force", "N", "hand", "force");
  for (const char* motor : {"1", "2", "3"})
    channels_.add(std::string("hand/torque") + motor, "N m", "hand", "torque");
  time_ = channels_.add("time/step", "s", "time", "step");
  channels_.add("time/longest", "s", "time", "step");
  channels_.add("time/pace", "1", "time", "pace");
}

bool LabChannels::add_pairs(const LabFrame& frame) {
  bool any = false;
  for (const RecordedContact& c : frame.recorded.contacts)
    if (channels_.add_pair(c.a, c.b)) any = true;
  return any;
}

void LabChannels::values(const LabFrame& frame, const Snapshot& moment, SceneCouplings* couplings,
                         std::vector<double>& values) const {
  channels_.values(frame.recorded, moment, couplings, values);
  if (frame.pull) values[pull_] = frame.pull->force_W.norm();
  if (frame.hand) {
    values[hand_] = frame.hand->force_W.norm();
    for (std::size_t i = 0; i < 3; ++i) values[hand_ + 1 + i] = frame.hand->torque[i];
  }
  values[time_] = frame.step_time;
  values[time_ + 1] = frame.longest_step;
  values[time_ + 2] = frame.pace;
}

}  // namespace twinarm
