// Mechanisms, observers and error measures of the cases without contact.
#pragma once

#include "benchmarks/analytic/support/analytic_case.h"
#include "benchmarks/analytic/support/reference_math.h"
#include "solver/dynamics/energy_momentum.h"
#include "solver/dynamics/model_builder.h"

namespace twinarm {

using ModelRef = const Model<double>&;
using StateRef = const State<double>&;
using Real = long double;  // of references
inline constexpr Real kPi = std::numbers::pi_v<Real>;

// ---- mechanisms ----

Model<double> weightless(Model<double> model);  // without gravity
// One free body, principal moments about its centre [kg m^2], no gravity.
Model<double> free_body(double mass, const Vector3& moments);
// One body on one joint at the world's origin, gravity (0, 0, -9.81).
Model<double> one_body(JointType type, const Vector3& axis, const BodyInertia& inertia,
                       const JointProperties& properties = {});
// 1 kg on a massless rod of 1 m, revolute joint about y; angle 0: at -z.
Model<double> point_pendulum();

CaseScene at_rest(Model<double> model);
// The same, marked as one whose energy changes.
CaseScene not_conserving(CaseScene scene);
CaseScene start_at(Model<double> model, std::vector<double> q, std::vector<double> qd);

// Torque or force law(t, q) on one dof, q its coordinate, which must have the same index among the
// coordinates.
template <class Law>
std::shared_ptr<ForceSource> joint_effort(Law law, std::size_t dof = 0) {
  return std::make_shared<ForceLaw>(
      [law, dof](const State<double>& x, const Kinematics&, Forces<double>& forces) {
        forces.tau[dof] += law(x.t, x.q[dof]);
      });
}

// ---- observers ----

// One number of a state: reading, or function whose zeros are events.
using Observed = std::function<double(ModelRef, StateRef)>;
inline Observed coordinate(std::size_t i) {
  return [i](ModelRef, StateRef x) { return x.q[i]; };
}
inline Observed velocity(std::size_t i) {
  return [i](ModelRef, StateRef x) { return x.qd[i]; };
}
inline CaseObserver observe(Observed number) {
  return [number](ModelRef model, StateRef x) { return CaseReadings{number(model, x)}; };
}
inline CaseObserver joint_state() {  // all coordinates, then all velocities
  return [](ModelRef, StateRef x) {
    CaseReadings all = x.q;
    all.insert(all.end(), x.qd.begin(), x.qd.end());
    return all;
  };
}
inline CaseReference constantly(CaseReadings values) {
  return [values](double) { return values; };
}

// Positions, velocities, and accelerations under gravity, joint friction and joint torques.
Workspace<double> evaluate(ModelRef model, StateRef x, const std::vector<double>& tau = {});
std::vector<double> inverse_dynamics(const Model<double>& model, const State<double>& x,
                                     const std::vector<double>& qdd);
// Reaction force of the joint of body 1, world axes [N].
Vector3 reaction(ModelRef model, StateRef x);
// Eigenvalues of -d(qdd)/dq, ascending: squared frequencies, negative if unstable.
std::vector<double> squared_frequencies_of(ModelRef model, StateRef x);
// Undamped frequencies about a stable state of rest, ascending [rad/s].
std::vector<double> small_frequencies(ModelRef model, StateRef x);

// Of a free body 1: quaternion w, x, y, z, and angular velocity in body axes.
CaseReadings attitude_and_rate(const Eigen::Quaterniond& attitude, const Vector3& rate);
CaseReadings observe_attitude_and_rate(ModelRef, StateRef x);

inline CaseReadings observe_energy(ModelRef model, StateRef x) {
  return {kinetic_energy(model, x) + potential_energy(model, x)};
}

// ---- measures ----

// max(angle between the attitudes, norm of the difference of the rates).
double attitude_and_rate_error(const CaseReadings& seen, const CaseReadings& exact);
// Largest relative error of the readings.
double relative_each(const CaseReadings& seen, const CaseReadings& exact);

// ---- plane chains of links that hang along -z from the origin; angles rotate -z to x ----

struct ChainLink {
  double mass = 1, length = 1;
  double com = 0.5;      // from the link's joint [m]
  double inertia = 0;    // about the centre of mass [kg m^2]
  bool in_line = false;  // a rod: no inertia about its own axis
};
inline ChainLink rod_link(double mass, double length) {
  return {mass, length, length / 2, mass * length * length / 12, true};
}
inline ChainLink point_link(double mass, double length) {
  return {mass, length, length, 0, true};
}

// Joint angles are relative to the parent.
Model<double> plane_chain(const std::vector<ChainLink>& links, double gravity = kGravity);
Model<double> plane_chain(const ChainLink& link, int count);

// Angles and rates relative to the vertical.
CaseObserver absolute_angles();

// Solution of the equations of motion `rates` from (q, qd) at time 0.
std::function<CaseReadings(double)> solution_of(special::Rates rates, special::Numbers start);

}  // namespace twinarm
