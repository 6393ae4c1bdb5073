#include "app/lab/run/lab_inputs.h"

#include "app/device/devices.h"
#include "coupling/analysis/joint_space_stiffness.h"
#include "solver/forces/spring.h"
#include "solver/linear_algebra/dense_algebra.h"

namespace twinarm {

OperatorInput::OperatorInput() {
  mapping_.kind = MappingKind::cartesian;
  mapping_.scale = 5;
  // A dragged stylus is held by a compliant arm model. Scaled by virtual work its force would be 25
  // times as stiff and oscillate at the motors' limit, so it gets a fifth of the force at the tip.
  mapping_.force_scale = 1 / (mapping_.scale * mapping_.scale);
  // Low-pass: damping of 300 N s/m on 0.15 kg, held for a step, would oscillate.
  force_.cutoff = 15;
}

void OperatorInput::choose(Source source, const std::string& spec) {
  std::shared_ptr<DesktopInput> gestures;
  std::unique_ptr<InputDevice> device;
  if (source == Source::device) device = open_device(spec);
  if (source == Source::drag) {
    VirtualOmniSettings settings;
    settings.parameters.resolution = 0;  // scaled encoder counts per tick disturb the dampers
    gestures = std::make_shared<DesktopInput>(settings.parameters);
    device = std::make_unique<VirtualOmni>(gestures, settings);
    gestures->button(0, gripper_);
  }
  device_ = std::move(device);
  gestures_ = std::move(gestures);
  source_ = source;
  spec_ = source == Source::device ? spec : "";
  tip_.reset();
  joints_.clear();
  ++revision_;
}

void OperatorInput::restart() {
  gripper_ = false;
  renew();
}

std::string OperatorInput::description() const {
  if (device_) return device_->description();
  return source_ == Source::joints ? "joint sliders" : "scene motion";
}

void OperatorInput::joint(std::size_t driven, double value) {
  constexpr std::size_t kMax = 64;
  if (driven >= kMax || !std::isfinite(value)) return;
  if (joints_.size() <= driven) joints_.resize(driven + 1);
  joints_[driven] = value;
}

void OperatorInput::axes(const std::array<double, 6>& rates) {
  tip_.reset();  // they start from the present position of the stylus
  if (gestures_) gestures_->axes(rates);
}

void OperatorInput::button(std::size_t index, bool down) {
  if (index == 0) gripper_ = down;
  if (gestures_) gestures_->button(index, down);
}

void OperatorInput::release() {
  tip_.reset();
  if (!gestures_) return;
  gestures_->release();
  gestures_->button(0, gripper_);
}

MouseSpring::MouseSpring(const Model<double>& model, const RunPlan& plan)
    : model_(model),
      is_implicit_(facts_of(plan.integrator).implicit_force && !plan.locates_events),
      moves_first_(plan.integrator == Integrator::semi_implicit_xv),
      k_(model) {
  given_.reserve(model.parent.size());
}

std::optional<MouseSpringInput> MouseSpring::grab(const State<double>& x, int body,
                                                  const Vector3& p_L, const Vector3& goal_W) const {
  if (body <= 0 || body >= model_.body_count() || !p_L.allFinite() || !goal_W.allFinite())
    return std::nullopt;
  const Kinematics k = kinematics_at(model_, x);
  const Eigen::Matrix3Xd J = point_jacobian(model_, k, body, k.position(body, p_L));
  const Matrix3 mobility = J * inverse_of(mass_matrix(model_, x)) * J.transpose();
  const Eigen::VectorXd eigenvalues = symmetric_eigenvalues(mobility);
  const double max = eigenvalues.maxCoeff();
  if (!(max > 1e-12)) return std::nullopt;
  const auto rank = static_cast<double>((eigenvalues.array() > 1e-9 * max).count());
  const double m = rank / mobility.trace(), stiffness = m * kOmega * kOmega;
  return MouseSpringInput{body, p_L, goal_W, stiffness, 2 * m * kOmega, stiffness * kMaxStretch};
}

MouseSpring::Reading MouseSpring::read(const Kinematics& k) const {
  const Vector3 p = k.position(input_->body, input_->p_L), v = k.velocity(input_->body, p);
  const Vector3 spring = input_->k * (input_->goal_W - p);
  const double size = spring.norm(), h = is_implicit_ ? h_ : 0;
  if (size > input_->max_force)  // saturated: constant force and damper
    return {Vector3(input_->max_force / size * spring - input_->b * v), h * input_->b};
  return {Vector3(spring - (h * input_->k + input_->b) * v), h * input_->b + h * h * input_->k};
}

void MouseSpring::add_forces(const State<double>&, const Kinematics& k,
                             Forces<double>& forces) noexcept {
  if (!input_) return;
  reading_ = read(k);
  const Vector3 p = k.position(input_->body, input_->p_L);
  if (reading_.m_star > 0) add_particle(k, input_->body, p, reading_.m_star, forces);
  add_point_force(k, input_->body, p, reading_.force, forces);
}

void MouseSpring::book(double h, std::span<const double> weights, const State<double>& start,
                       const std::vector<State<double>>& inner, const State<double>& end) {
  mean_force_.setZero();
  if (!input_) return;
  auto sum = std::ranges::find(given_, input_->body, &Given::body);
  if (sum == given_.end()) sum = given_.insert(given_.end(), {input_->body, {}});
  const Vector3 before = sum->exchange.impulse;
  if (is_implicit_) {
    account_implicit(h, start, end, sum->exchange);
  } else {
    account_part(weights.front() * h, start, sum->exchange);
    for (std::size_t s = 0; s < inner.size(); ++s)
      account_part(weights[s + 1] * h, inner[s], sum->exchange);
    account_part(weights.back() * h, end, sum->exchange);
  }
  mean_force_ = (sum->exchange.impulse - before) / h;
}

// Impulse h F - m* (v' - v), with the Jacobian of the pose where F was evaluated; work with the
// mean of both velocities.
void MouseSpring::account_implicit(double h, const State<double>& start, const State<double>& end,
                                   EnergyMomentum& sum) {
  State<double> at = moves_first_ ? end : start;
  at.qd = start.qd;
  forward_kinematics(model_, at, k_);
  const Vector3 p = k_.position(input_->body, input_->p_L), v = k_.velocity(input_->body, p);
  at.qd = end.qd;
  forward_kinematics(model_, at, k_);
  const Vector3 v_end = k_.velocity(input_->body, p);
  const Vector3 impulse = h * reading_.force - reading_.m_star * (v_end - v);
  sum.add_wrench(1, p, impulse, Vector3::Zero());
  sum.work += impulse.dot(0.5 * (v + v_end));
}

void MouseSpring::account_part(double weight, const State<double>& x, EnergyMomentum& sum) {
  forward_kinematics(model_, x, k_);
  const Vector3 p = k_.position(input_->body, input_->p_L), force = read(k_).force;
  sum.add_wrench(weight, p, force, Vector3::Zero());
  sum.work += weight * force.dot(k_.velocity(input_->body, p));
}

void MouseSpring::visit_books(StateArchive& memory) {
  memory.resize(given_, sizeof(EnergyMomentum));
  for (Given& part : given_) {
    memory.visit(part.body);
    part.exchange.serialize(memory);
  }
}

}  // namespace twinarm
