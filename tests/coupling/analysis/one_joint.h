// One joint, a motion at rest or at constant speed, and a coupling.
#pragma once

#include <memory>

#include "coupling/analysis/tracking.h"
#include "solver/dynamics/model_builder.h"
#include "solver/stepping/simulation.h"

namespace twinarm::testing {

// Moves joint j of the robot along angle[j] + rate[j] t.
class SteadyHand final : public OperatorMotion {
 public:
  std::array<double, 3> angle{}, rate{};
  OperatorSample sample(double t, double) const override {
    OperatorSample hand;
    for (std::size_t j = 0; j < 3; ++j)
      mapping().set_robot_angle(hand, j, angle[j] + rate[j] * t, rate[j]);
    return hand;
  }
  double duration() const override { return 1; }
  std::string description() const override { return "steady"; }
  static OperatorMapping mapping() { return {}; }
};

// Revolute about z with inertia `inertia` [kg m^2], or prismatic along x with that mass [kg]; no
// gravity.
inline Model<double> one_joint(JointType type, double inertia) {
  ModelBuilder builder;
  builder.set_gravity(Vector3::Zero());
  const bool turns = type == JointType::revolute;
  const BodyInertia body{turns ? 1.0 : inertia, Vector3::Zero(),
                         inertia * Vector3(1, 1, 1).asDiagonal().toDenseMatrix()};
  builder.add_body("link", 0, "joint1", type, {}, turns ? Vector3::UnitZ() : Vector3::UnitX(),
                   body);
  return builder.build();
}

// KVR, coupling and DVR of one model, ready to step. Not movable: the parts hold references.
struct Coupled {
  Model<double> model;
  SteadyHand hand;
  TargetRobot kvr;
  std::unique_ptr<Coupling> coupling;
  Simulation simulation;

  Coupled(const Model<double>& m, const SteadyHand& h, std::vector<std::string> joints,
          const CouplingSpec& spec, const State<double>& start,
          Integrator integrator = Integrator::semi_implicit)
      : model(m),
        hand(h),
        kvr(model, hand, SteadyHand::mapping(), {std::move(joints), "", 0, 0}),
        coupling(make_coupling(spec, model, kvr)),
        simulation(model, start) {
    simulation.set_integrator(integrator);
    simulation.add(*coupling);
  }
  Coupled(const Coupled&) = delete;
};

inline State<double> state_of(const Model<double>& model, std::vector<double> q,
                              std::vector<double> qd) {
  State<double> x(model);
  x.q = std::move(q);
  x.qd = std::move(qd);
  return x;
}

}  // namespace twinarm::testing
