#include "app/lab/run/lab_inputs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/device/devices.h"
#include "coupling/analysis/joint_space_stiffness.h"
#include "solver/forces/spring.h"
#include "solver/linear_algebra/dense_algebra.h"

namespace twinarm {

LabHand::LabHand() {
  mapping_.kind = MappingKind::cartesian;
  mapping_.scale = 5;
  // What a mouse drags is held by a soft arm: with the power of virtual work, 25 times as stiff, it
  // would buzz against its motors' limit. So the stylus feels a fifth of the force on the tip.
  mapping_.force_scale = 1 / (mapping_.scale * mapping_.scale);
  // And not each millisecond's damping: held for a step, 300 N s/m on 0.15 kg would swing to and
  // fro.
  force_.cutoff = 15;
}

void LabHand::choose(Source source, const std::string& spec) {
  std::shared_ptr<DesktopInput> gestures;
  std::unique_ptr<HandDevice> device;
  if (source == Source::device) device = open_device(spec);
  if (source == Source::drag) {
    VirtualOmniSettings settings;
    // No encoders: their counts, magnified and divided by a millisecond, are felt in every damper.
    settings.figures.resolution = 0;
    gestures = std::make_shared<DesktopInput>(settings.figures);
    device = std::make_unique<VirtualOmni>(gestures, settings);
    gestures->button(0, gripper_);
  }
  device_ = std::move(device);
  gestures_ = std::move(gestures);
  source_ = source;
  spec_ = source == Source::device ? spec : "";
  tip_.reset();
  joints_.clear();
  ++chosen_;
}

std::string LabHand::description() const {
  if (device_) return device_->description();
  return source_ == Source::joints ? "driven joint by joint" : "as the scene says";
}

void LabHand::tip(const Vector3& goal_W, double stamp) {
  if (!goal_W.allFinite()) return;
  tip_ = goal_W;
  stamp_ = stamp;
}

void LabHand::joint(std::size_t driven, double value, double stamp) {
  constexpr std::size_t kMax = 64;
  if (driven >= kMax || !std::isfinite(value)) return;
  if (joints_.size() <= driven) joints_.resize(driven + 1);
  joints_[driven] = value;
  stamp_ = stamp;
}

void LabHand::turn(double yaw, double pitch, double roll, double stamp) {
  if (gestures_) gestures_->turn_stylus({yaw, pitch, roll});
  stamp_ = stamp;
}

void LabHand::axes(const std::array<double, 6>& rates, double stamp) {
  tip_.reset();  // they move on from where the stylus is
  if (gestures_) gestures_->axes(rates);
  stamp_ = stamp;
}

void LabHand::button(std::size_t index, bool down, double stamp) {
  if (index == 0) gripper_ = down;
  if (gestures_) gestures_->button(index, down);
  stamp_ = stamp;
}

void LabHand::release() {
  tip_.reset();
  if (!gestures_) return;
  gestures_->release();
  gestures_->button(0, gripper_);
}

MouseSpring::MouseSpring(const Model<double>& model, const RunPlan& plan)
    : model_(model),
      is_implicit_(facts_of(plan.integrator).implicit_force && !plan.locates_events),
      drifts_first_(plan.integrator == Integrator::semi_implicit_xv),
      k_(model) {
  given_.reserve(model.parent.size());
}

std::optional<PullInput> MouseSpring::grab(const State<double>& x, int body, const Vector3& p_L,
                                           const Vector3& goal_W) const {
  if (body <= 0 || body >= model_.body_count() || !p_L.allFinite() || !goal_W.allFinite())
    return std::nullopt;
  Kinematics k(model_);
  forward_kinematics(model_, x, k);
  const Eigen::Matrix3Xd J = point_jacobian(model_, k, body, k.position(body, p_L));
  const Matrix3 felt = J * inverse_of(mass_matrix(model_, x)) * J.transpose();
  const Eigen::VectorXd axes = symmetric_eigenvalues(felt);
  const double largest = axes.maxCoeff();
  if (!(largest > 1e-12)) return std::nullopt;
  const auto rank = static_cast<double>((axes.array() > 1e-9 * largest).count());
  const double m = rank / felt.trace(), stiffness = m * kOmega * kOmega;
  return PullInput{body, p_L, goal_W, stiffness, 2 * m * kOmega, stiffness * kLongestStretch};
}

MouseSpring::Reading MouseSpring::read(const Kinematics& k) const {
  const Vector3 p = k.position(pull_->body, pull_->p_L), v = k.velocity(pull_->body, p);
  const Vector3 spring = pull_->k * (pull_->goal_W - p);
  const double size = spring.norm(), h = is_implicit_ ? h_ : 0;
  if (size > pull_->most)  // a force of one size, and the damper
    return {Vector3(pull_->most / size * spring - pull_->b * v), h * pull_->b};
  return {Vector3(spring - (h * pull_->k + pull_->b) * v), h * pull_->b + h * h * pull_->k};
}

void MouseSpring::add_forces(const State<double>&, const Kinematics& k,
                             Forces<double>& forces) noexcept {
  if (!pull_) return;
  reading_ = read(k);
  const Vector3 p = k.position(pull_->body, pull_->p_L);
  if (reading_.m_star > 0) add_particle(k, pull_->body, p, reading_.m_star, forces);
  add_point_force(k, pull_->body, p, reading_.force, forces);
}

void MouseSpring::book(double h, std::span<const double> weights, const State<double>& start,
                       const std::vector<State<double>>& inner, const State<double>& end) {
  shown_.setZero();
  if (!pull_) return;
  const auto on_it = [&](const Given& part) { return part.body == pull_->body; };
  auto place = std::ranges::find_if(given_, on_it);
  if (place == given_.end()) place = given_.insert(given_.end(), {pull_->body, {}});
  const Vector3 before = place->exchange.impulse;
  if (is_implicit_) {
    book_step(h, start, end, place->exchange);
  } else {
    book_part(weights.front() * h, start, place->exchange);
    for (std::size_t s = 0; s < inner.size(); ++s)
      book_part(weights[s + 1] * h, inner[s], place->exchange);
    book_part(weights.back() * h, end, place->exchange);
  }
  shown_ = (place->exchange.impulse - before) / h;
}

// h F - m* (v' - v), v by the Jacobian of the place where F was found; its work is over the mean of
// both velocities.
void MouseSpring::book_step(double h, const State<double>& start, const State<double>& end,
                            EnergyMomentum& sum) {
  State<double> at = drifts_first_ ? end : start;
  at.qd = start.qd;
  forward_kinematics(model_, at, k_);
  const Vector3 p = k_.position(pull_->body, pull_->p_L), v = k_.velocity(pull_->body, p);
  at.qd = end.qd;
  forward_kinematics(model_, at, k_);
  const Vector3 v_end = k_.velocity(pull_->body, p);
  const Vector3 impulse = h * reading_.force - reading_.m_star * (v_end - v);
  sum.add_wrench(1, p, impulse, Vector3::Zero());
  sum.work += impulse.dot(0.5 * (v + v_end));
}

void MouseSpring::book_part(double part, const State<double>& x, EnergyMomentum& sum) {
  forward_kinematics(model_, x, k_);
  const Vector3 p = k_.position(pull_->body, pull_->p_L), force = read(k_).force;
  sum.add_wrench(part, p, force, Vector3::Zero());
  sum.work += part * force.dot(k_.velocity(pull_->body, p));
}

void MouseSpring::visit_books(StateArchive& memory) {
  memory.resize(given_, sizeof(EnergyMomentum));
  for (Given& part : given_) {
    memory.visit(part.body);
    part.exchange.serialize(memory);
  }
}

}  // namespace twinarm
