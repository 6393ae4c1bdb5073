// Two uniform slender links with vertical revolute joints, moved by the paper's automatic motion.
#pragma once

#include "coupling/analysis/tracking.h"
#include "coupling/target/operator_motion.h"
#include "solver/dynamics/model_builder.h"

namespace twinarm::testing {

struct TwoLink {
  double m1 = 5, m2 = 3, l1 = 0.4, l2 = 0.3;  // parameter set 0

  Model<double> model() const {
    const auto rod = [](double m, double l) {
      const double I = m * l * l / 12;
      return BodyInertia{m, {l / 2, 0, 0}, Vector3(0.01 * I, I, I).asDiagonal()};
    };
    ModelBuilder builder;
    builder.add_body("arm1", 0, "joint1", JointType::revolute, {}, Vector3::UnitZ(), rod(m1, l1));
    builder.add_body("arm2", 1, "joint2", JointType::revolute, {Matrix3::Identity(), {l1, 0, 0}},
                     Vector3::UnitZ(), rod(m2, l2));
    return builder.build();
  }
  // A spring on each link; linear ones at the centres of mass.
  std::vector<Spring> springs(double k, double b) const { return springs(k, b, k, b); }
  std::vector<Spring> springs(double k1, double b1, double k2, double b2) const {
    return {{"arm1", 1, {l1 / 2, 0, 0}, k1, b1}, {"arm2", 2, {l2 / 2, 0, 0}, k2, b2}};
  }
};

// Runs the coupling on the automatic motion; angles of the result in degrees.
struct Tracking {
  TrackingError error;      // [deg]
  std::vector<double> end;  // q1, q2, qd1, qd2 [rad, rad/s]
  bool finite;
};
inline Tracking track(const TwoLink& robot, const CouplingSpec& spec, double h,
                      Integrator integrator = Integrator::semi_implicit,
                      TargetRates rates = TargetRates::from_operator, double sweep_time = 1.0) {
  const Model<double> model = robot.model();
  const OperatorMapping mapping;
  const AutomaticMotion hand(mapping, sweep_time);
  TrackingSetup setup;
  setup.kvr_model = setup.dvr_model = &model;
  setup.motion = &hand;
  setup.joints.turned = {"joint1", "joint2"};
  setup.couplings = {spec};
  setup.kvr_rates = rates;
  setup.integrator = integrator;
  setup.h = h;
  TrackingSystem system(setup);
  const TrackingSeries series = system.run();
  Tracking result{tracking_error(series), {}, series.finite};
  for (double& e : result.error.max) e /= kDegree;
  for (double& e : result.error.mean) e /= kDegree;
  const State<double>& x = system.simulation().state();
  result.end = {x.q[0], x.q[1], x.qd[0], x.qd[1]};
  return result;
}

inline CouplingSpec torsional(std::vector<Spring> springs, SpringSpace measure,
                              Discretization discretization = Discretization::explicit_) {
  CouplingSpec spec;
  spec.type = CouplingSpec::Type::torsional;
  spec.measure = measure;
  spec.discretization = discretization;
  spec.springs = std::move(springs);
  return spec;
}
inline CouplingSpec linear(std::vector<Spring> springs,
                           Discretization discretization = Discretization::explicit_) {
  CouplingSpec spec = torsional(std::move(springs), SpringSpace::world, discretization);
  spec.type = CouplingSpec::Type::linear;
  return spec;
}
inline CouplingSpec printed(CouplingSpec::Type type, std::vector<Spring> springs,
                            AsPublishedOptions options) {
  CouplingSpec spec;
  spec.type = type;
  spec.printed = true;
  spec.options = options;
  spec.springs = std::move(springs);
  return spec;
}

}  // namespace twinarm::testing
