#include "coupling/device/force_feedback.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace twinarm {
namespace {

constexpr double kMinLever = 0.1;  // of the stylus about the motors, for their inertia [m]

}  // namespace

CouplingReaction::CouplingReaction(const Model<double>& model, const std::vector<int>& turned)
    : model_(model), driven_(model, turned), tau_(turned.size()) {}

void CouplingReaction::add(const CouplingSpec& spec, const Coupling& coupling) {
  const CouplingFacts& facts = facts_of(spec.type, spec.printed);
  const Kind kind = facts.acts_at_joint(spec.measure) ? Kind::joint
                    : facts.at_point                  ? Kind::point
                                                      : Kind::turn;
  const std::size_t n = coupling.springs().size();
  for (std::size_t r = 0; r < coupling.readings().size(); ++r)  // forces, then couples
    parts_.push_back({&coupling, r, r % n, r < n ? kind : Kind::turn, Vector3::Zero(), false});
}

Vector3 CouplingReaction::velocity_of(const Part& part, const State<double>& x,
                                      const Kinematics& D) const {
  const Spring& spring = part.coupling->springs()[part.spring];
  const auto i = static_cast<std::size_t>(spring.body);
  switch (part.kind) {
    case Kind::point:
      return D.velocity(spring.body, D.position(spring.body, spring.p_L));
    case Kind::turn:
      return D.w_WL[i];
    case Kind::joint:
      break;
  }
  return {x.qd[model_.iv[i]], 0, 0};
}

void CouplingReaction::add_reaction(const Part& part, const Vector3& pull, double size,
                                    const Kinematics& K) {
  const Spring& spring = part.coupling->springs()[part.spring];
  if (part.kind == Kind::joint) {
    const std::size_t dof = model_.iv[static_cast<std::size_t>(spring.body)];
    if (driven_.joint[dof] >= 0)
      tau_[static_cast<std::size_t>(driven_.joint[dof])] -= driven_.ratio[dof] * size;
    return;
  }
  const Vector3& p = part.coupling->readings()[part.reading].p_K;
  for_each_dof_below(model_, K, spring.body,
                     [&](std::size_t dof, const Vector3& w, const Vector3& v, const Vector3& o) {
                       if (driven_.joint[dof] < 0) return;
                       const Vector3 J = part.kind == Kind::turn ? w : Vector3(v + w.cross(p - o));
                       tau_[static_cast<std::size_t>(driven_.joint[dof])] -=
                           driven_.ratio[dof] * J.dot(pull);
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
    const Vector3 less = over_h * (velocity - part.velocity);
    part.velocity = velocity;
    part.known = true;
    add_reaction(part, reading.pull - less, reading.size - less.x(), kvr.k);
  }
  return tau_;
}

double stylus_force(const OmniParameters& omni, const OmniAngles& theta, const Vector3& torque) {
  // Where the arm is stretched, or above the waist, some torques are no force at all there: they
  // count as that of a lever of a millimetre.
  constexpr double kLever = 1e-3;  // [m]
  const Matrix3 J = omni_jacobian(omni, theta);
  const Matrix3 A = J.transpose() * J + kLever * kLever * Matrix3::Identity();
  return (J * (A.inverse() * torque)).norm();
}

HandForce::HandForce(const HandForceSpec& spec, const OmniParameters& omni, DeviceMapping& mapping)
    : spec_(spec),
      omni_(omni),
      mapping_(mapping),
      passivity_(omni.peak_force * spec.fastest / omni.rate,
                 0.5 * omni.apparent_mass * kMinLever * kMinLever * omni.rate * omni.rate) {}

DeviceForce HandForce::tick(const DeviceState& device, const std::vector<double>& tau,
                            double h) noexcept {
  const DeviceForce wanted = mapping_.feel(device, tau);
  const Vector3 felt(wanted.torque[0], wanted.torque[1], wanted.torque[2]);
  const double part =
      spec_.cutoff > 0 ? -std::expm1(-2 * std::numbers::pi * spec_.cutoff * h) : 1.0;
  smooth_ += part * (felt - smooth_);
  passivity_.moved_to({device.theta[0], device.theta[1], device.theta[2]});
  Vector3 torque = spec_.passive ? passivity_.damped(smooth_) : smooth_;
  const double most = omni_.peak_force * (spec_.passive ? passivity_.allowance() : 1.0);
  const double size = stylus_force(omni_, device.theta, torque);
  if (size > most) torque *= most / size;
  passivity_.holds(torque);
  return {{torque.x(), torque.y(), torque.z()}};
}

}  // namespace twinarm
