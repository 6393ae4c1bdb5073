#include "coupling/device/virtual_omni.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/support/diagnostics.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

constexpr int kSubsteps = 4;        // per tick
constexpr long kMaxTicks = 250;     // simulated in one poll
constexpr double kSameTick = 1e-6;  // rounding of a sum of steps [ticks]

void check_settings(const VirtualOmniSettings& s) {
  DiagnosticList faults;
  const OmniParameters& o = s.parameters;
  const auto demand = [&](bool valid, const char* where, double value, const char* allowed) {
    if (!valid)
      faults.add(where, "is " + short_number_text(value) + ", must be " + allowed,
                 "the device's own value is in docs/understand/phantom_omni.md", "device.figure");
  };
  using Entry = std::pair<const char*, double>;
  for (const auto& [where, value] :
       {Entry{"L1", o.L1}, Entry{"L2", o.L2}, Entry{"rate", o.rate},
        Entry{"peak_force", o.peak_force},
        Entry{"apparent_mass + arm.mass", o.apparent_mass + s.arm.mass}})
    demand(std::isfinite(value) && value > 0, where, value, "more than zero");
  for (const auto& [where, value] :
       {Entry{"resolution", o.resolution}, Entry{"friction", o.friction},
        Entry{"apparent_mass", o.apparent_mass}, Entry{"arm.mass", s.arm.mass},
        Entry{"arm.stiffness", s.arm.stiffness}, Entry{"arm.damping", s.arm.damping},
        Entry{"device_damping", s.device_damping}})
    demand(std::isfinite(value) && value >= 0, where, value, "zero or more");
  for (const auto& [where, value] :
       {Entry{"delay_to_host", s.delay_to_host}, Entry{"delay_to_motors", s.delay_to_motors}})
    demand(value >= 0 && value <= 10, where, value, "from 0 to 10 s");
  for (std::size_t j = 0; j < 6; ++j)
    demand(o.lower[j] < o.upper[j], "upper", o.upper[j], "above the joint's lower limit");
  faults.check();
}

// exp(h A) of x' = v, v' = (-k x - b v + f) / m, f constant.
Matrix3 exponential_of_mass(double k, double b, double m, double h) {
  Matrix3 A;
  A << 0, 1, 0, -k / m, -b / m, 1 / m, 0, 0, 0;
  A *= h;
  int halvings = 0;
  for (; A.cwiseAbs().maxCoeff() > 0.25; ++halvings) A *= 0.5;
  Matrix3 sum = Matrix3::Identity(), term = sum;
  for (int n = 1; n <= 16; ++n) {
    term = Matrix3(term * A) / n;
    sum += term;
  }
  for (; halvings > 0; --halvings) sum = Matrix3(sum * sum);
  return sum;
}

}  // namespace

VirtualOmni::VirtualOmni(std::shared_ptr<const OperatorMotion> motion,
                         const VirtualOmniSettings& settings)
    : motion_(std::move(motion)),
      parameters_(settings.parameters),
      viscous_(settings.device_damping),
      period_(1 / settings.parameters.rate),
      delay_to_host_(settings.delay_to_host),
      delay_to_motors_(settings.delay_to_motors),
      response_{} {
  check_settings(settings);
  const ArmImpedance& arm = settings.arm;
  const Matrix3 E = exponential_of_mass(arm.stiffness, arm.damping + viscous_,
                                        parameters_.apparent_mass + arm.mass, period_ / kSubsteps);
  response_ = {E(0, 0), E(0, 1), E(0, 2), E(1, 0), E(1, 1), E(1, 2)};
  sensed_.resize(stored_steps(delay_to_host_, period_) + 2);
  rendered_.resize(stored_steps(delay_to_motors_, period_) + 2);
  update_angles();
  const auto q = omni_nearest(parameters_, omni_position(parameters_, wanted_.theta));
  truth_.theta = {q[0], q[1], q[2], 0, 0, 0};
  truth_.position = omni_position(parameters_, truth_.theta);
  sense();
}

DeviceState VirtualOmni::poll(double now) noexcept {
  if (!polled_ && std::isfinite(now)) {
    polled_ = true;
    origin_ = now_ = now;
  }
  if (now > now_ && std::isfinite(now)) now_ = now;
  const double max_tick = static_cast<double>(tick_ + kMaxTicks);
  const double due = std::floor((now_ - origin_) / period_ + kSameTick);
  if (due > max_tick) origin_ += (due - max_tick) * period_;  // skip a long pause
  for (const auto last = static_cast<long>(std::min(due, max_tick)); tick_ < last;) tick();
  const double seen = std::floor((now_ - origin_ - delay_to_host_) / period_ + kSameTick);
  const auto n = static_cast<std::size_t>(std::max(seen, 0.0));
  DeviceState state = sensed_[n % sensed_.size()];
  state.t = origin_ + static_cast<double>(n) * period_;
  return state;
}

void VirtualOmni::render(const DeviceForce& force) noexcept {
  const double due = std::ceil((now_ - origin_ + delay_to_motors_) / period_ - kSameTick);
  const long from = std::max(static_cast<long>(due), tick_);
  rendered_[static_cast<std::size_t>(from) % rendered_.size()] = {from, force.torque};
}

void VirtualOmni::tick() noexcept {
  const Rendered& next = rendered_[static_cast<std::size_t>(tick_) % rendered_.size()];
  if (next.tick == tick_) held_ = omni_limit(parameters_, truth_.theta, next.torque);

  const double h = period_ / kSubsteps;
  const Matrix3 J = omni_jacobian(parameters_, wanted_.theta);
  const auto& rate = wanted_.theta_dot;
  const Vector3 goal_velocity = J * Vector3(rate[0], rate[1], rate[2]);
  for (int n = 0; n < kSubsteps; ++n) {
    substep(truth_.goal, goal_velocity);
    truth_.goal += h * goal_velocity;
  }
  ++tick_;
  update_angles();
  sense();
}

void VirtualOmni::substep(const Vector3& goal, const Vector3& goal_velocity) noexcept {
  Vector3 &x = truth_.position, &v = truth_.velocity;
  const bool at_rest = v.isZero(0);
  truth_.motors = omni_force(parameters_, truth_.theta, held_);
  const double force = truth_.motors.norm();  // changes with the pose although torques are held
  if (force > parameters_.peak_force) truth_.motors *= parameters_.peak_force / force;

  // Without friction, relative to a goal of constant velocity: u = x - g.
  const Response& r = response_;
  const Vector3 u = x - goal, u_dot = v - goal_velocity;
  const Vector3 input = truth_.motors - viscous_ * goal_velocity;
  const Vector3 x_free =
      goal + period_ / kSubsteps * goal_velocity + r.xx * u + r.xv * u_dot + r.xf * input;
  const Vector3 v_free = goal_velocity + r.vx * u + r.vv * u_dot + r.vf * input;

  // Constant friction force that stops the point within the substep, at most Coulomb's limit.
  const double speed = v_free.norm(), to_stop = speed / r.vf;
  truth_.sticks = to_stop <= parameters_.friction;
  if (truth_.sticks) {
    if (!at_rest) x = x_free - r.xf / r.vf * v_free;
    v.setZero();
  } else {
    const Vector3 against = parameters_.friction / speed * v_free;
    x = x_free - r.xf * against;
    v = v_free - r.vf * against;
  }
  stop_at_ranges();
}

void VirtualOmni::stop_at_ranges() noexcept {
  constexpr double kRounding = 1e-9;  // [rad]
  const auto q = omni_inverse(parameters_, truth_.position);
  bool within = q.has_value();
  for (std::size_t j = 0; within && j < 3; ++j)
    within =
        (*q)[j] >= parameters_.lower[j] - kRounding && (*q)[j] <= parameters_.upper[j] + kRounding;
  if (within) {
    std::copy(q->begin(), q->end(), truth_.theta.begin());
    return;
  }
  const auto edge = omni_nearest(parameters_, truth_.position);
  std::copy(edge.begin(), edge.end(), truth_.theta.begin());
  const Vector3 stop = omni_position(parameters_, truth_.theta);
  const Vector3 beyond = truth_.position - stop;
  const double outward = truth_.velocity.dot(beyond);
  if (outward > 0) truth_.velocity -= outward / beyond.squaredNorm() * beyond;
  truth_.position = stop;
}

void VirtualOmni::update_angles() noexcept {
  const double t = static_cast<double>(tick_) * period_;
  const OperatorSample now = motion_->sample(t, t + period_);
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(now.theta.begin(), now.theta.end(), finite) ||
      !std::all_of(now.theta_dot.begin(), now.theta_dot.end(), finite)) {
    wanted_.theta_dot = {};  // not finite: keep the last goal
  } else {
    wanted_ = now;
  }
  truth_.goal = omni_position(parameters_, wanted_.theta);
}

void VirtualOmni::sense() noexcept {
  const double count = parameters_.resolution / parameters_.L1;
  DeviceState& state = sensed_[static_cast<std::size_t>(tick_) % sensed_.size()];
  for (std::size_t j = 0; j < 6; ++j) {
    double& theta = truth_.theta[j];
    if (j > 2) theta = wanted_.theta[j];
    theta = std::clamp(theta, parameters_.lower[j], parameters_.upper[j]);
    const double seen = count > 0 ? count * std::round(theta / count) : theta;
    state.theta[j] = std::clamp(seen, parameters_.lower[j], parameters_.upper[j]);
  }
  state.stylus = omni_stylus(parameters_, state.theta);
  state.buttons = {wanted_.button, wanted_.clutch};
}

}  // namespace twinarm
