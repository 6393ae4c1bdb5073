#include "app/lab/run/input_override.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace twinarm {
namespace {

constexpr double kRemembered = 2.0;  // of the hand, for couplings that see it late [s]

std::size_t steps_remembered(double h) {
  return static_cast<std::size_t>(kRemembered / h) + 2;
}

// The first wins: a device's, any hand's, one that stands still.
int rank_of_target(const SceneCoupling& coupling) {
  if (coupling.target == CouplingTarget::Kind::device) return 2;
  return coupling.driven.turned.empty() ? 0 : 1;
}

bool has_one_hand(const SceneCoupling& a, const SceneCoupling& b) {
  return a.robot == b.robot && a.target == b.target && a.trace == b.trace && a.seed == b.seed &&
         a.duration == b.duration && a.delay == b.delay && a.speed == b.speed &&
         a.driven.turned == b.driven.turned;
}

}  // namespace

InputOverride::InputOverride(SceneModel* scene, LabHand& hand, double h)
    : scene_(scene), hand_(hand), live_(steps_remembered(h)), first_(1) {
  if (scene_) choose_pulls();
}

void InputOverride::choose_pulls() {
  std::vector<SceneCoupling>& all = scene_->couplings;
  const SceneCoupling* leader = nullptr;
  for (const SceneCoupling& c : all)
    if (c.leads() && !c.outside && c.speed == 1 &&
        (!leader || rank_of_target(c) > rank_of_target(*leader)))
      leader = &c;
  if (!leader) return;
  if (leader->driven.turned.empty()) {
    const std::vector<std::string> joints = turned_joints(*scene_, leader->robot);
    for (SceneCoupling& c : all)
      if (c.robot == leader->robot && !c.outside && c.driven.turned.empty())
        c.driven.turned = joints;
  }
  if (leader->driven.turned.empty()) return;
  for (std::size_t c = 0; c < all.size(); ++c)
    if (has_one_hand(all[c], *leader)) led_.push_back(c);
  turned_ = turned_bodies(*scene_, leader->driven);
  target_.q.assign(turned_.size(), 0);
  target_.qd.assign(turned_.size(), 0);
}

HandInPlace InputOverride::in_place() {
  return [this](std::size_t pull,
                std::unique_ptr<OperatorMotion> own) -> std::unique_ptr<OperatorMotion> {
    if (std::ranges::find(led_, pull) == led_.end()) return own;
    if (pull == led_.front()) own_ = own.get();
    const auto instead = [this](double t, double toward) { return source_at(t, toward); };
    return std::make_unique<ReplacedHand>(std::move(own), instead);
  };
}

// Null: the scene's own, before the lab's hand leads and elsewhere.
const OperatorMotion* InputOverride::source_at(double t, double toward) const {
  double inside = t + 1e-9 * (toward - t);
  if (inside == t) inside = std::nextafter(t, toward);
  if (!leads_ || inside < first_.newest().t) return nullptr;
  return inside <= first_.duration() ? &first_ : &live_;
}

void InputOverride::go_on_from(const LabHandFrame& frame) {
  if (!frame.leads || frame.q_K.size() != target_.q.size()) return;
  target_.q = frame.q_K;
  target_.gripper_closed = frame.gripper_closed;
  goes_on_ = true;
}

void InputOverride::stand_as(const LabHandFrame& frame, double t, double h) {
  if (!frame.leads || frame.q_K.size() != target_.q.size()) return;
  target_.q = frame.q_K;
  target_.qd = frame.qd_K;
  target_.gripper_closed = frame.gripper_closed;
  live_.set(target_, t - h, h);
  first_.set(live_.newest());
  leads_ = stands_ = true;
  ask_elsewhere(t);
}

std::vector<double> InputOverride::own_q(double t, double toward) const {
  const HandSample sample = own_->sample(t, toward);
  std::vector<double> q;
  for (std::size_t j = 0; j < turned_.size(); ++j)
    q.push_back(HandMapping{}.robot_angle(sample, j));
  return q;
}

void InputOverride::take_over(double t, double h) {
  if (!goes_on_) {
    target_.q = own_q(t, t + h);
    target_.gripper_closed = own_->sample(t, t + h).button;
  }
  std::ranges::fill(target_.qd, 0.0);
  goes_on_ = false;
}

void InputOverride::make_loop(double h) {
  made_for_ = hand_.chosen();
  is_live_ = true;
  loop_.reset();
  if (!hand_.device()) return;
  loop_ = std::make_unique<HandLoop>(*scene_, *couplings_, led_, *hand_.device(),
                                     HandLoopOptions{hand_.mapping(), hand_.force()});
  loop_->begin(target_.q, hand_.tick(h));
  is_fresh_ = true;
}

// No joint faster than LabHand::kFastest.
void InputOverride::move_towards(const std::vector<double>& goal, double h) {
  const double most = LabHand::kFastest * h;
  for (std::size_t j = 0; j < target_.q.size(); ++j) {
    const double before = target_.q[j], way = goal[j] - before;
    target_.q[j] = std::abs(way) <= most ? goal[j] : before + std::copysign(most, way);
    target_.qd[j] = (target_.q[j] - before) / h;
  }
}

void InputOverride::follow_tip() {
  if (!hand_.gestures() || !hand_.tip_goal()) return;
  if (const auto stylus = loop_->mapping().stylus_for(*hand_.tip_goal()))
    hand_.gestures()->place(*stylus);
}

// A kinematic robot that was asked for its target at t, as ledgers do, keeps the answer: where
// another hand begins to lead, that is no longer true. Asked for another time it forgets.
void InputOverride::ask_elsewhere(double t) {
  for (const std::size_t pull : led_) couplings_->target(pull, t - 1);
}

std::optional<HandStep> InputOverride::before_step(const State<double>& x, double t, double h) {
  if (led_.empty()) return std::nullopt;
  const LabHand::Source source = hand_.source();
  if (std::exchange(stands_, false)) leads_ = false;
  if (!leads_ && !goes_on_ && source == LabHand::Source::scene) return std::nullopt;
  const bool begins = !leads_;
  if (begins) {
    take_over(t, h);
    ask_elsewhere(t);
  }
  if (!is_live_ || made_for_ != hand_.chosen()) make_loop(h);
  std::vector<double> goal = target_.q;
  if (source == LabHand::Source::scene) {
    goal = own_q(t, t + h);
    move_towards(goal, h);
    if (target_.q == goal) {
      leads_ = false;
      ask_elsewhere(t);
      return std::nullopt;
    }
  } else if (loop_) {
    follow_tip();
    // At first as the device was when it took over: the robot stands where it stood.
    target_ = loop_->before_step(x, hand_.tick(is_fresh_ ? 0 : h), h);
    is_fresh_ = false;
  } else {
    const auto& goals = hand_.joint_goals();
    for (std::size_t j = 0; j < std::min(goal.size(), goals.size()); ++j)
      goal[j] = goals[j].value_or(goal[j]);
    move_towards(goal, h);
    target_.gripper_closed = hand_.gripper_closed();
  }
  live_.set(target_, t, h);
  if (begins) first_.set(live_.newest());
  leads_ = true;
  return live_.newest();
}

void InputOverride::take_again(const std::optional<HandStep>& told) {
  is_live_ = goes_on_ = false;
  if (std::exchange(stands_, false)) leads_ = false;
  const bool led = leads_;
  if (!told || led_.empty()) {
    leads_ = false;
    return;
  }
  if (!led) ask_elsewhere(told->t);
  live_.set(*told);
  if (!leads_) first_.set(*told);
  leads_ = true;
  for (std::size_t j = 0; j < target_.q.size(); ++j) {
    target_.q[j] = HandMapping{}.robot_angle(told->hand, j);
    target_.qd[j] = HandMapping{}.robot_rate(told->hand, j);
  }
  target_.gripper_closed = told->hand.button;
}

void InputOverride::after_step(const Simulation& simulation, double h, bool finite) noexcept {
  if (loop_ && is_live_ && leads_) loop_->after_step(simulation, h, finite);
}

std::optional<LabHandFrame> InputOverride::frame(double t) const {
  if (led_.empty()) return std::nullopt;
  LabHandFrame frame;
  frame.leads = leads_ || goes_on_;
  frame.q_K = frame.leads ? target_.q : own_q(t, t - 1e-6);
  frame.qd_K.assign(turned_.size(), 0.0);
  if (frame.leads) frame.qd_K = target_.qd;
  frame.gripper_closed = frame.leads ? target_.gripper_closed : own_->sample(t, t - 1e-6).button;
  // A device that was chosen since the last step has not moved anything yet.
  if (!loop_ || !is_live_ || made_for_ != hand_.chosen()) return frame;
  const OmniParameters& figures = hand_.device()->figures();
  frame.theta = loop_->device().theta;
  frame.torque = loop_->felt().torque;
  frame.force_W = world_from_device(omni_force(figures, frame.theta, frame.torque));
  frame.mode = static_cast<int>(loop_->watch().mode());
  return frame;
}

std::vector<std::size_t> InputOverride::couplings() const {
  std::vector<std::size_t> places;
  const std::vector<CouplingDescription>& all = scene_->description.couplings;
  for (std::size_t place = 0; place < all.size(); ++place)
    for (const std::size_t pull : led_)
      if (scene_->couplings[pull].coupling == all[place].name && scene_->couplings[pull].leads())
        places.push_back(place);
  return places;
}

std::optional<std::pair<int, Vector3>> InputOverride::tip() const {
  if (led_.empty()) return std::nullopt;
  return led_point(*scene_, led_);
}

}  // namespace twinarm
