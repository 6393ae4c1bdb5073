// What several of the smooth cases are made of.
#pragma once

#include <Eigen/Geometry>

#include "benchmarks/analytic/support/analytic_case.h"
#include "benchmarks/analytic/support/reference_math.h"
#include "solver/dynamics/energy_momentum.h"
#include "solver/dynamics/model_builder.h"
#include "solver/model/workspace.h"
#include "solver/support/checkpointable.h"

namespace twinarm::smooth_parts {

// ---- mechanisms ----

// One free body of these principal moments about its centre, without gravity [kg m^2].
Model<double> free_body(double mass, const Vector3& moments);
// One body on one joint at the world's origin, gravity (0, 0, -9.81).
Model<double> one_body(JointType type, const Vector3& axis, const BodyInertia& inertia,
                       const JointProperties& properties = {}, const Pose& X_PJ = {});
// 1 kg on a massless rod, hinge along y; it hangs on -z at angle 0.
Model<double> point_pendulum(double length = 1);

CaseScene at_rest(Model<double> model);
// Something takes energy out of it, or puts it in.
CaseScene not_conserving(CaseScene scene);
CaseScene start_at(Model<double> model, std::vector<double> q, std::vector<double> qd);
inline CaseObserver joint_state() {  // all coordinates, then all velocities
  return [](const Model<double>&, const State<double>& x) {
    CaseReadings all = x.q;
    all.insert(all.end(), x.qd.begin(), x.qd.end());
    return all;
  };
}

// A torque or force on one dof, by time and by the dof's coordinate, which has its number among
// the velocities.
class JointEffort : public ForceSource, public Checkpointable {
 public:
  using Law = std::function<double(double t, double q)>;
  explicit JointEffort(Law law, std::size_t dof = 0) : law_(std::move(law)), dof_(dof) {}
  void add_forces(const State<double>& x, const Kinematics&,
                  Forces<double>& forces) noexcept override {
    forces.tau[dof_] += law_(x.t, x.q[dof_]);
  }

 private:
  Law law_;
  std::size_t dof_;
};

// ---- what is seen ----

// Positions, velocities, and accelerations under gravity, joint friction and nothing else.
Workspace<double> evaluate(const Model<double>& model, const State<double>& x);
// Generalised forces for given accelerations.
std::vector<double> inverse_dynamics(const Model<double>& model, const State<double>& x,
                                     const std::vector<double>& qdd);
// What the joint of the first body transmits, for its true acceleration: force, world axes [N].
Vector3 reaction(const Model<double>& model, const State<double>& x);
// Eigenvalues of -d(qdd)/dq, ascending: squares of the frequencies, negative where it is unstable.
std::vector<double> squared_frequencies_of(const Model<double>& model, const State<double>& x);
// Undamped frequencies about a state at rest, ascending [rad/s].
std::vector<double> small_frequencies(const Model<double>& model, const State<double>& x);

// Of a free body that is the first of its model: w, x, y, z of its attitude, and the angular
// velocity in body axes.
CaseReadings attitude_and_rate(const Eigen::Quaterniond& attitude, const Vector3& rate);
CaseReadings observe_attitude_and_rate(const Model<double>&, const State<double>& x);

inline CaseReadings observe_energy(const Model<double>& model, const State<double>& x) {
  return {kinetic_energy(model, x) + potential_energy(model, x)};
}

// ---- measures ----

// The larger of the angle between the attitudes and the length of the difference of the rates.
double attitude_and_rate_error(const CaseReadings& seen, const CaseReadings& exact);
// The largest of what each reading is off, relative to itself.
double relative_each(const CaseReadings& seen, const CaseReadings& exact);

// ---- plane chains of links, hanging on -z from the world's origin, that turn from -z to x ----

struct ChainLink {
  double mass = 1, length = 1;
  double com = 0.5;      // from the link's joint [m]
  double inertia = 0;    // about the centre of mass [kg m^2]
  bool in_line = false;  // a rod: no inertia about itself
};
inline ChainLink rod_link(double mass, double length) {
  return {mass, length, length / 2, mass * length * length / 12, true};
}
inline ChainLink point_link(double mass, double length) {
  return {mass, length, length, 0, true};
}

// Angles are those between neighbours.
Model<double> plane_chain(const std::vector<ChainLink>& links, double gravity = kGravity);
Model<double> plane_chain(const ChainLink& link, int count);

// Angles and rates from the vertical, in place of those of the joints.
CaseObserver absolute_angles();

// The case's own equations, from (q, qd) at time 0.
std::function<CaseReadings(double)> solution_of(special::Rates rates, special::Numbers start);

}  // namespace twinarm::smooth_parts
