// All couplings with all discretizations on a chain of three revolute joints, for contract tests.
#pragma once

#include <Eigen/Geometry>

#include "coupling/analysis/prediction.h"
#include "coupling/laws/coupling_spec.h"
#include "solver/dynamics/dynamics.h"
#include "tests/coupling/analysis/one_joint.h"
#include "tests/solver/dynamics/random_tree.h"

namespace twinarm::testing {

using CouplingType = CouplingSpec::Type;

inline const std::vector<std::string> kThreeJoints{"joint1", "joint2", "joint3"};

struct Law {
  std::string name;
  CouplingType type;
  bool printed;
  SpringSpace measure;
  Discretization discretization;
  bool own;  // fixed discretization
  const CouplingFacts& facts;

  bool is(CouplingType t) const { return type == t; }
  bool in_six_dimensions() const { return is(CouplingType::bushing) || is(CouplingType::weld); }
  bool on_orientation() const { return !facts.at_point && !at_joint(); }
  bool on_joint() const { return at_joint() && facts.is_spring_damper; }

 private:
  // AsPublishedOptions also have a spring space.
  bool at_joint() const {
    return facts.at_joint || (is(CouplingType::torsional) && measure == SpringSpace::joint);
  }
};

// coupling/laws/coupling_spec.h times discretizations times spring spaces.
inline std::vector<Law> all_laws() {
  using Discretizations = CouplingFacts::Discretizations;
  std::vector<Law> laws;
  for (const CouplingFacts& facts : all_couplings)
    for (const Discretization discretization :
         {Discretization::explicit_, Discretization::semi_implicit, Discretization::implicit})
      for (const SpringSpace measure : {SpringSpace::world, SpringSpace::joint}) {
        if (facts.discretizations != Discretizations::all &&
            discretization != Discretization::explicit_)
          continue;
        if (facts.type != CouplingType::torsional && measure == SpringSpace::joint) continue;
        const std::string of = facts.discretizations == Discretizations::own
                                   ? ""
                                   : std::string(", ") + name_of(discretization);
        const std::string at = facts.type != CouplingType::torsional ? ""
                               : measure == SpringSpace::world       ? ", world"
                                                                     : ", joint";
        laws.push_back({facts.name + at + of, facts.type, facts.printed, measure, discretization,
                        facts.discretizations == Discretizations::own, facts});
      }
  return laws;
}

inline CouplingSpec spec_of(const Law& law, std::vector<Spring> springs) {
  CouplingSpec spec;
  spec.name = law.name;
  spec.type = law.type;
  spec.printed = law.printed;
  spec.measure = spec.options.measure = law.measure;
  spec.discretization = law.discretization;
  spec.reference = {0.1, 0.9, 0.9};
  spec.springs = std::move(springs);
  return spec;
}
inline std::vector<Spring> chain_springs(double k, double b) {
  return {{"first", 1, {0.2, 0.1, -0.1}, k, b, 0.7 * k, 0.4 * b},
          {"second", 2, {-0.1, 0.2, 0.1}, 0.5 * k, 2 * b, 0.2 * k, 0.3 * b},
          {"third", 3, {0.1, 0, 0.2}, 0.3 * k, 0.7 * b, 0.6 * k, 0.9 * b}};
}

// Three revolute joints in random directions, moved by X_W from the world's origin.
inline Model<double> chain_of_three(unsigned seed, const Pose& X_W = {}) {
  Random random(seed);
  ModelBuilder builder;
  builder.set_gravity(Vector3::Zero());
  for (int i = 1; i <= 3; ++i) {
    Pose X{random.rotation(), random.vector(0.4)};
    if (i == 1) X = X_W * X;
    builder.add_body("link" + std::to_string(i), i - 1, "joint" + std::to_string(i),
                     JointType::revolute, X, random.vector(1), random.inertia());
  }
  return builder.build();
}
inline SteadyHand hand_at(const Vector3& q, const Vector3& qd = Vector3::Zero()) {
  SteadyHand hand;
  hand.angle = {q[0], q[1], q[2]};
  hand.rate = {qd[0], qd[1], qd[2]};
  return hand;
}
inline State<double> three_state(const Model<double>& model, const Vector3& q, const Vector3& qd) {
  return state_of(model, {q[0], q[1], q[2]}, {qd[0], qd[1], qd[2]});
}

// Forces and spring states of a new coupling in a step of h.
struct Evaluated {
  Kinematics D, K;  // of the DVR; of the KVR at the start of the step
  Forces<double> forces;
  std::vector<SpringState> readings;
};
inline Evaluated evaluated(const CouplingSpec& spec, const Model<double>& model,
                           const SteadyHand& hand, const Vector3& q, const Vector3& qd,
                           double h = 1e-3, TargetRates rates = TargetRates::from_operator) {
  TargetRobot kvr(model, hand, SteadyHand::mapping(), {kThreeJoints, "", 0, 0}, rates);
  const auto coupling = make_coupling(spec, model, kvr);
  const State<double> x = three_state(model, q, qd);
  Evaluated all{Kinematics(model), Kinematics(model), Forces<double>(model), {}};
  forward_kinematics(model, x, all.D);
  coupling->begin_step(all.D, 0, h);
  coupling->add_forces(x, all.D, all.forces);
  all.K = kvr.start().k;
  all.readings = coupling->readings();
  return all;
}

// Joint force of a new coupling: M times the change of the accelerations.
inline Vector3 generalised_force(const CouplingSpec& spec, const Model<double>& model,
                                 const SteadyHand& hand, const Vector3& q, const Vector3& qd) {
  const Evaluated all = evaluated(spec, model, hand, q, qd);
  const State<double> x = three_state(model, q, qd);
  const auto qdd = [&](const Forces<double>& forces) {
    Workspace<double> w(model);
    aba(model, x, forces, w);
    return Vector3(w.qdd[0], w.qdd[1], w.qdd[2]);
  };
  return mass_matrix(model, x) * (qdd(all.forces) - qdd(Forces<double>(model)));
}

// f by central differences, column by column.
template <class F>
Matrix3 derivative(F&& f, const Vector3& x, double step) {
  Matrix3 D;
  for (Eigen::Index j = 0; j < 3; ++j) {
    const Vector3 e = step * Vector3::Unit(j);
    D.col(j) = (f(Vector3(x + e)) - f(Vector3(x - e))) / (2 * step);
  }
  return D;
}

}  // namespace twinarm::testing
