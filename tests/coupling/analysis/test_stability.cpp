// Stability limits of coupling/analysis/prediction.h against simulations
// (docs/understand/stability_of_spring_dampers.md), and the periodic orbit of the as-published,
// unsigned damper (docs/understand/coupling_laws.md).
#include <doctest/doctest.h>

#include <numbers>

#include "tests/coupling/analysis/growth.h"
#include "tests/coupling/analysis/two_link.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

// Bisection of `stable` between a stable and an unstable value.
template <class Stable>
double edge(Stable&& stable, double inside, double outside) {
  while (std::abs(outside - inside) > 1e-9 * std::abs(inside)) {
    const double middle = 0.5 * (inside + outside);
    (stable(middle) ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace

TEST_CASE("every scheme's limit in alpha is where a simulation begins to grow, to half a percent") {
  int edges = 0;
  for (const SteppingScheme scheme : all_schemes)
    for (const auto type : {CouplingSpec::Type::torsional, CouplingSpec::Type::linear})
      for (double beta : {0.15, 0.5, 0.8, 1.3, 3.0}) {
        const auto predicted = [&](double alpha) { return is_stable(scheme, alpha, beta); };
        const auto measured = [&](double alpha) { return !grows(scheme, type, alpha, beta); };
        std::vector<double> alphas;  // predicted to be stable
        for (double alpha = 0.02; alpha < 40; alpha *= 1.2)
          if (predicted(alpha)) alphas.push_back(alpha);
        CAPTURE(name_of(scheme));
        CAPTURE(beta);
        if (alphas.empty()) {
          for (double alpha : {0.02, 0.3, 2.0, 6.0}) CHECK_FALSE(measured(alpha));
          continue;
        }
        const double inside = alphas[alphas.size() / 2];
        CHECK(measured(inside));
        for (const double outside : {40.0, 0.02}) {  // too stiff, or too soft for its damping
          if (predicted(outside)) continue;
          const double limit = edge(predicted, inside, outside);
          const double half_percent = outside > inside ? 0.005 * limit : -0.005 * limit;
          CAPTURE(limit);
          CHECK(measured(limit - half_percent));
          CHECK_FALSE(measured(limit + half_percent));
          ++edges;
        }
      }
  CHECK(edges >= 50);
}

TEST_CASE("the implicit discretization is stable at every alpha and beta") {
  for (const auto type : {CouplingSpec::Type::torsional, CouplingSpec::Type::linear})
    for (double alpha : {1e-2, 1.0, 1e2, 1e6, 1e10})
      for (double beta : {0.0, 0.1, 1e2, 1e6})
        CHECK_FALSE(grows(SteppingScheme::implicit, type, alpha, beta));
}

TEST_CASE(
    "max_stable_step of a two-link arm is where its simulation begins to grow, to half a percent") {
  const TwoLink arm;
  const Model<double> model = arm.model();
  for (const auto type : {CouplingSpec::Type::torsional, CouplingSpec::Type::linear})
    for (const SteppingScheme scheme :
         {SteppingScheme::euler, SteppingScheme::semi_implicit,
          SteppingScheme::semi_implicit_difference, SteppingScheme::implicit_damper}) {
      const double gain = type == CouplingSpec::Type::linear ? 30 : 1;
      const std::vector<Spring> springs = arm.springs(600 * gain, 9 * gain, 200 * gain, 2 * gain);
      const Stepper stepper = stepper_of(scheme, type, springs);
      Coupled still(model, {}, {}, stepper.spec, State<double>(model), stepper.integrator);
      const Coupling::JointSpace space = still.coupling->joint_space(still.simulation.kinematics());
      const double predicted =
          max_stable_step(mass_matrix(model, State<double>(model)), space.K, space.B, scheme);
      CAPTURE(name_of(scheme));
      CAPTURE(predicted);
      const auto stable = [&](double h) {
        return !grows(stepper, model, State<double>(model), h, 8000);
      };
      CHECK(stable(0.3 * predicted));
      CHECK(stable(0.995 * predicted));
      CHECK_FALSE(stable(1.005 * predicted));
    }
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(2, 2);
  CHECK(std::isinf(max_stable_step(one, 100 * one, one, SteppingScheme::implicit)));
}

namespace {

// Turning points of e = q_K - q_D, relative to the first (0.1 rad), over 10 s.
std::vector<double> turning_points(Damper damper, double sign, double zeta) {
  const double w = 10, h = 2e-5, speed = 1.5, e0 = 0.1, seconds = 10;
  CouplingSpec spec;
  spec.printed = true;
  spec.options.damper = damper;
  spec.options.damping_sign = sign;
  spec.springs = {
      {"spring", 1, Vector3::Zero(), kHingeInertia * w * w, 2 * zeta * w * kHingeInertia}};
  SteadyHand hand;
  hand.angle[0] = e0;
  hand.rate[0] = speed;
  const Model<double> model = one_joint(JointType::revolute, kHingeInertia);
  Coupled system(model, hand, {"joint1"}, spec, state_of(model, {0}, {speed}));
  std::vector<double> points;
  double before = e0, now = e0;
  for (long n = 1; n < std::lround(seconds / h); ++n) {
    system.simulation.step(h);
    const double t = static_cast<double>(n) * h;
    const double next = e0 + speed * t - system.simulation.state().q[0];
    if (n > 1 && (now - before) * (next - now) < 0) points.push_back(now / e0);
    before = now;
    now = next;
  }
  return points;
}

}  // namespace

TEST_CASE("the unsigned damper never damps: turning points 1 and -exp(pi z/sqrt(1-z^2)) forever") {
  const double z = 0.2, ratio = std::exp(std::numbers::pi * z / std::sqrt(1 - z * z));
  CHECK(ratio == doctest::Approx(1.89890027).epsilon(1e-8));
  for (const double sign : {1.0, -1.0}) {  // along the KVR's motion, against it
    const std::vector<double> points = turning_points(Damper::unsigned_, sign, z);
    CHECK(points.size() > 28);
    const double other = sign > 0 ? -ratio : -1 / ratio;
    for (std::size_t n = 0; n < points.size(); ++n)
      CHECK(points[n] == doctest::Approx(n % 2 == 0 ? other : 1.0).epsilon(2e-3));
  }
}

TEST_CASE("the signed damper damps: each turning point is exp(-pi z/sqrt(1-z^2)) of the last") {
  const double z = 0.2, ratio = std::exp(-std::numbers::pi * z / std::sqrt(1 - z * z));
  const std::vector<double> points = turning_points(Damper::vector_, 1, z);
  REQUIRE(points.size() > 8);
  for (std::size_t n = 1; n < 8; ++n)
    CHECK(points[n] / points[n - 1] == doctest::Approx(-ratio).epsilon(2e-3));
}
