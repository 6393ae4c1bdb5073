// Mechanisms of one body with a known motion, and a helper that runs them.
#pragma once

#include <cmath>
#include <numbers>

#include "solver/dynamics/model_builder.h"
#include "solver/stepping/simulation.h"

namespace twinarm::testing {

constexpr double kRight = std::numbers::pi / 2;

// A point mass on a massless rod of 1 m, revolute about y; along -z at angle 0.
inline Model<double> pendulum() {
  ModelBuilder builder;
  builder.add_body("bob", 0, "hinge", JointType::revolute, {}, Vector3::UnitY(),
                   {1.0, {0, 0, -1}, Matrix3::Zero()});
  return builder.build();
}

inline Model<double> free_body(const BodyInertia& inertia, const Vector3& gravity) {
  ModelBuilder builder;
  builder.set_gravity(gravity);
  builder.add_body("body", 0, "free", JointType::free, {}, Vector3::UnitZ(), inertia);
  return builder.build();
}

inline State<double> run(const Model<double>& model, const State<double>& start,
                         Integrator integrator, double h, long steps) {
  Simulation simulation(model, start);
  simulation.set_integrator(integrator);
  for (long n = 0; n < steps; ++n) simulation.step(h);
  return simulation.state();
}

// Of one joint.
inline State<double> state_at(const Model<double>& model, double q, double qd) {
  State<double> x(model);
  x.q[0] = q;
  x.qd[0] = qd;
  return x;
}

// The pendulum released at (q, qd), after `time`.
inline State<double> swing(double q, double qd, Integrator integrator, double h, double time) {
  const Model<double> model = pendulum();
  return run(model, state_at(model, q, qd), integrator, h, std::lround(time / h));
}

}  // namespace twinarm::testing
