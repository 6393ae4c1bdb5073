// Coupling and integrator of each stepping scheme of coupling/analysis/gains.h, and whether a small
// motion grows in a simulation.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "coupling/analysis/prediction.h"
#include "tests/coupling/analysis/one_joint.h"

namespace twinarm::testing {

inline constexpr double kHingeInertia = 0.7, kFrame = 0.01, kSmall = 1e-9;
inline constexpr int kHeld = 20;  // steps of the integrator in one held step

// The stability condition of each SteppingScheme.
inline bool is_stable(SteppingScheme scheme, double alpha, double beta) {
  switch (scheme) {
    case SteppingScheme::euler:
      return alpha < beta && beta < 2 + alpha / 2;
    case SteppingScheme::semi_implicit:
    case SteppingScheme::semi_implicit_difference:
      return alpha < 4 - 2 * beta;
    case SteppingScheme::euler_difference:
      return beta < 1 && alpha < beta * (1 - beta);
    case SteppingScheme::semi_implicit_older:
      return beta < 1 && alpha < 1 - beta;
    case SteppingScheme::hold:
      return alpha < 2 * beta && beta < 2;
    case SteppingScheme::hold_difference:
      return beta < 2 && alpha < 2 * beta * (2 - beta) / (2 + beta);
    case SteppingScheme::rk4: {
      const std::complex<double> root = std::sqrt(std::complex<double>(beta * beta - 4 * alpha));
      const auto grows_by = [](std::complex<double> l) {
        return std::abs(1.0 + l * (1.0 + l / 2.0 * (1.0 + l / 3.0 * (1.0 + l / 4.0))));
      };
      return grows_by((root - beta) / 2.0) < 1 && grows_by((-root - beta) / 2.0) < 1;
    }
    case SteppingScheme::implicit_damper:
      return alpha < 4 + 2 * beta;
    case SteppingScheme::implicit:
      return true;
  }
  return false;
}

struct Stepper {
  CouplingSpec spec;
  Integrator integrator = Integrator::semi_implicit;
  int substeps = 1;
};

// Coupling and integrator of a scheme: torsional on a revolute, or linear on a prismatic joint.
inline Stepper stepper_of(SteppingScheme scheme, CouplingSpec::Type type,
                          std::vector<Spring> springs) {
  Stepper s;
  s.spec.type = type;
  s.spec.springs = std::move(springs);
  s.spec.options.damper = Damper::vector_;
  switch (scheme) {
    case SteppingScheme::euler:
      s.integrator = Integrator::euler;
      break;
    case SteppingScheme::semi_implicit:
      break;
    case SteppingScheme::euler_difference:
      s.integrator = Integrator::euler;
      s.spec.printed = true;
      break;
    case SteppingScheme::semi_implicit_difference:
      s.spec.printed = true;
      break;
    case SteppingScheme::semi_implicit_older:
      s.spec.printed = true;
      s.spec.options.difference = Difference::older;
      break;
    case SteppingScheme::hold:
    case SteppingScheme::hold_difference:
      s.integrator = Integrator::rk4;
      s.substeps = s.spec.hold_steps = s.spec.options.hold_steps = kHeld;
      s.spec.printed = scheme == SteppingScheme::hold_difference;
      break;
    case SteppingScheme::rk4:
      s.integrator = Integrator::rk4;
      break;
    case SteppingScheme::implicit_damper:
      s.spec.discretization = Discretization::semi_implicit;
      break;
    case SteppingScheme::implicit:
      s.spec.discretization = Discretization::implicit;
      break;
  }
  return s;
}

// Whether a small motion about the KVR at rest grows: maximum of the last quarter of the steps
// against the second quarter. Coordinates are angles and lengths.
inline bool grows(const Stepper& stepper, const Model<double>& model, const State<double>& pose,
                  double h, int steps) {
  State<double> start = pose;
  for (std::size_t j = 0; j < model.nq; ++j) start.q[j] += j % 2 == 0 ? kSmall : -0.7 * kSmall;
  Coupled system(model, {}, {}, stepper.spec, start, stepper.integrator);
  system.kvr.set_pose(pose);
  double early = 0, late = 0;
  for (int n = 0; n < steps; ++n) {
    for (int m = 0; m < stepper.substeps; ++m) system.simulation.step(h / stepper.substeps);
    double size = 0;
    for (std::size_t j = 0; j < model.nq; ++j)
      size = std::max(size, std::abs(system.simulation.state().q[j] - pose.q[j]));
    if (!(size < 1e6 * kSmall)) return true;
    if (size < 1e-6 * kSmall && n > steps / 4) return false;
    double& window = n < steps / 2 ? early : late;
    if (n >= 3 * steps / 4 || (n >= steps / 4 && n < steps / 2)) window = std::max(window, size);
  }
  return late > 1.01 * early;  // tolerance for undamped motion sampled once a step
}

inline bool grows(SteppingScheme scheme, CouplingSpec::Type type, double alpha, double beta) {
  const JointType joint =
      type == CouplingSpec::Type::linear ? JointType::prismatic : JointType::revolute;
  const std::vector<Spring> springs{{"spring", 1, Vector3::Zero(),
                                     alpha * kHingeInertia / (kFrame * kFrame),
                                     beta * kHingeInertia / kFrame}};
  const Model<double> model = one_joint(joint, kHingeInertia);
  return grows(
      stepper_of(scheme, type, springs), model, State<double>(model), kFrame,
      scheme == SteppingScheme::hold || scheme == SteppingScheme::hold_difference ? 800 : 4000);
}

// Stability limit of a simulation, to 1e-4, between 0.9 and 1.1 of the prediction.
template <class Stable>
double measured_limit(Stable&& stable, double predicted) {
  double inside = 0.9 * predicted, outside = 1.1 * predicted;
  CHECK(stable(inside));
  CHECK_FALSE(stable(outside));
  while (outside - inside > 1e-4 * predicted) {
    const double middle = (inside + outside) / 2;
    (stable(middle) ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace twinarm::testing
