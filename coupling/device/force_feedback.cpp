#include "coupling/device/force_feedback.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace twinarm {
namespace {

constexpr double kMinLever = 0.1;  // lever arm of the stylus for the motors' inertia [m]

}  // namespace

CouplingReaction::CouplingReaction(const Model<double>& model, const std::vector<int>& turned)
    : model_(model), driven_(model, turned), tau_(turned.size()) {}

void CouplingReaction::add(const CouplingSpec& spec, const Coupling& coupling) {
  const CouplingFacts& facts = facts_of(spec.type, spec.printed);
  const Kind kind = facts.acts_at_joint(spec.measure) ? Kind::joint
                    : facts.at_point                  ? Kind::point
                                                      : Kind::orientation;
  const std::size_t n = coupling.springs().size();
  for (std::size_t r = 0; r < coupling.readings().size(); ++r)  // forces, then torques
    parts_.push_back(
        {&coupling, r, r % n, r < n ? kind : Kind::orientation, Vector3::Zero(), false});
}

Vector3 CouplingReaction::velocity_of(const Part& part, const State<double>& x,
                                      const Kinematics& D) const {
  const Spring& spring = part.coupling->springs()[part.spring];
  const auto i = static_cast<std::size_t>(spring.body);
  switch (part.kind) {
    case Kind::point:
      return D.velocity(spring.body, D.position(spring.body, spring.p_L));
    case Kind::orientation:
      return D.w_WL[i];
    case Kind::joint:
      break;
  }
  return {x.qd[model_.iv[i]], 0, 0};
}

void CouplingReaction::add_reaction(const Part& part, const Vector3& force, double size,
                                    const Kinematics& K) {
  const Spring& spring = part.coupling->springs()[part.spring];
  if (part.kind == Kind::joint) {
    const std::size_t dof = model_.iv[static_cast<std::size_t>(spring.body)];
    if (driven_.joint[dof] >= 0)
      tau_[static_cast<std::size_t>(driven_.joint[dof])] -= driven_.ratio[dof] * size;
    return;
  }
  const Vector3& p = part.coupling->readings()[part.reading].p_K;
  for_each_dof_below(
      model_, K, spring.body,
      [&](std::size_t dof, const Vector3& w, const Vector3& v, const Vector3& o) {
        if (driven_.joint[dof] < 0) return;
        const Vector3 J = part.kind == Kind::orientation ? w : Vector3(v + w.cross(p - o));
        tau_[static_cast<std::size_t>(driven_.joint[dof])] -= driven_.ratio[dof] * J.dot(force);
      });
}

const std::vector<double>& CouplingReaction::after_step(const TargetSample& kvr,
                                                        const State<double>& x, const Kinematics& D,
                                                        double h) noexcept {
  std::fill(tau_.begin(), tau_.end(), 0.0);
  for (Part& part : parts_) {
    const SpringState& reading = part.coupling->readings()[part.reading];
    const Vector3 velocity = velocity_of(part, x, D);
    const double over_h = part.known && h > 0 ? reading.m_star / h : 0.0;
    const Vector3 inertial = over_h * (velocity - part.velocity);
    part.velocity = velocity;
    part.known = true;
    add_reaction(part, reading.force_W - inertial, reading.size - inertial.x(), kvr.k);
  }
  return tau_;
}

double stylus_force(const OmniParameters& omni, const OmniAngles& theta, const Vector3& torque) {
  constexpr double kLever = 1e-3;  // minimum lever arm, at singularities [m]
  const Matrix3 J = omni_jacobian(omni, theta);
  const Matrix3 A = J.transpose() * J + kLever * kLever * Matrix3::Identity();
  return (J * (A.inverse() * torque)).norm();
}

ForceFeedback::ForceFeedback(const ForceFeedbackSpec& spec, const OmniParameters& omni,
                             DeviceMapping& mapping)
    : spec_(spec),
      omni_(omni),
      mapping_(mapping),
      passivity_(omni.peak_force * spec.fastest / omni.rate,
                 0.5 * omni.apparent_mass * kMinLever * kMinLever * omni.rate * omni.rate) {}

DeviceForce ForceFeedback::tick(const DeviceState& device, const std::vector<double>& tau,
                                double h) noexcept {
  const DeviceForce wanted = mapping_.motor_torques(device, tau);
  const Vector3 raw(wanted.torque[0], wanted.torque[1], wanted.torque[2]);
  const double part =
      spec_.cutoff > 0 ? -std::expm1(-2 * std::numbers::pi * spec_.cutoff * h) : 1.0;
  smooth_ += part * (raw - smooth_);
  passivity_.set_position({device.theta[0], device.theta[1], device.theta[2]});
  Vector3 torque = spec_.passive ? passivity_.passive_force(smooth_) : smooth_;
  const double max_force = omni_.peak_force * (spec_.passive ? passivity_.force_fraction() : 1.0);
  const double force = stylus_force(omni_, device.theta, torque);
  if (force > max_force) torque *= max_force / force;
  passivity_.set_held_force(torque);
  return {{torque.x(), torque.y(), torque.z()}};
}

}  // namespace twinarm
