#include "app/lab/stream/lab_moment.h"

#include <algorithm>
#include <cmath>

#include "app/record/shown_instant.h"

namespace twinarm {
namespace {

using Target = CouplingTarget::Kind;

bool is_moved(const SceneCoupling& coupling) {
  return coupling.target != Target::start && coupling.target != Target::state;
}

}  // namespace

LabMoments::LabMoments(const SimulatePlan& plan) {
  change(plan);
}

bool LabMoments::follows_device() const {
  const SceneModel* scene = plan_->input.scene.get();
  return scene && std::any_of(scene->couplings.begin(), scene->couplings.end(),
                              [](const auto& c) { return c.target == Target::device; });
}

void LabMoments::change(const SimulatePlan& plan) {
  std::unique_ptr<SceneCouplings> own, led;
  std::unique_ptr<SceneModel> in_hand;
  const double h = plan.run.step;
  if (const SceneModel* scene = plan.input.scene.get()) {
    own = std::make_unique<SceneCouplings>(*scene, h, &hand_);
    const auto& all = scene->couplings;
    const bool follows = std::any_of(all.begin(), all.end(),
                                     [](const auto& c) { return c.target == Target::device; });
    if (!follows && std::any_of(all.begin(), all.end(), is_moved)) {
      in_hand = std::make_unique<SceneModel>(*scene);
      for (SceneCoupling& coupling : in_hand->couplings)
        if (is_moved(coupling)) coupling.target = Target::device;
      led = std::make_unique<SceneCouplings>(*in_hand, h, &hand_);
    }
  }
  led_ = std::move(led);
  own_ = std::move(own);
  in_hand_ = std::move(in_hand);
  plan_ = &plan;
}

SceneCouplings* LabMoments::couplings(const LabFrame& frame) {
  return frame.hand && led_ ? led_.get() : own_.get();
}

void LabMoments::tell(const LabFrame& frame) {
  if (!frame.hand) return;
  hand_.tell(frame.hand->q_K, frame.hand->gripper_closed);
  SceneCouplings* told = couplings(frame);
  if (!told) return;
  // A kinematic robot does not look again at an instant that it has seen; but the hand may have
  // been elsewhere, in another branch.
  for (std::size_t c = 0; c < told->size(); ++c) told->target(c, frame.recorded.t + 1);
}

Moment LabMoments::at_start() {
  return moment_of(plan_->input, own_.get(), {plan_->input.robot.state.x, {}, {}});
}

Moment LabMoments::of(const LabFrame& frame) {
  tell(frame);
  const Model<double>& model = plan_->input.robot.model;
  Moment moment = moment_of(plan_->input, couplings(frame), instant_of(frame.recorded, model));
  if (frame.hand)
    moment.hands = {{frame.hand->theta, frame.hand->gripper_closed, frame.hand->force_W}};
  if (frame.pull && frame.pull->body > 0 && frame.pull->body < model.body_count()) {
    const LabPull& pull = *frame.pull;
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

}  // namespace twinarm
