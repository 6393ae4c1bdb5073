// Friction in one joint: recurrences, transition to sticking and to sliding.
#include <doctest/doctest.h>

#include <numbers>
#include <string>

#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/model_builder.h"
#include "solver/loops/constrained_dynamics.h"
#include "solver/stepping/simulation.h"
#include "tests/solver/stepping/pendulum.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

// A mass that slides along an axis.
Model<double> slider(double mass, const Vector3& axis, const JointProperties& properties) {
  ModelBuilder builder;
  builder.add_body("block", 0, "slide", JointType::prismatic, {}, axis,
                   {mass, Vector3::Zero(), Matrix3::Identity()}, properties);
  return builder.build();
}
JointProperties coulomb(double plus, double minus) {
  JointProperties p;
  p.coulomb_plus = plus;
  p.coulomb_minus = minus;
  return p;
}

template <class Law>
struct Push final : ForceSource {
  Law law;
  explicit Push(Law l) : law(l) {}
  void add_forces(const State<double>& x, const Kinematics&,
                  Forces<double>& forces) noexcept override {
    forces.tau[0] += law(x);
  }
};

}  // namespace

TEST_CASE(
    "viscous friction under the semi-implicit methods: v' (1 + h b/m) = v + h g, at every h") {
  JointProperties p;
  p.damping = 5;
  const Model<double> model = slider(2, {0, 0, -1}, p);
  for (const Integrator integrator : {Integrator::semi_implicit, Integrator::semi_implicit_xv})
    for (const double h : {0.01, 10.0}) {
      Simulation simulation(model, state_at(model, 0, 3));
      simulation.set_integrator(integrator);
      double v = 3;
      for (int n = 0; n < 50; ++n) {
        simulation.step(h);
        v = (v + h * 9.81) / (1 + h * 5 / 2);
        CHECK(simulation.state().qd[0] == doctest::Approx(v).epsilon(1e-13));
        CHECK(simulation.mechanism().dynamics.torques().damping[0] ==
              doctest::Approx(-5 * v).epsilon(1e-12));
      }
    }
}

TEST_CASE(
    "a spring against Coulomb friction turns at (-1)^n (0.097 - 0.01 n) and sticks at n = 10") {
  const Model<double> model = slider(1, Vector3::UnitX(), coulomb(0.5, 0.5));
  for (const IntegratorFacts& facts : all_integrators) {
    CAPTURE(std::string(facts.name));
    Push spring([](const State<double>& x) { return -100 * x.q[0]; });
    const bool crude =
        facts.integrator == Integrator::euler || facts.integrator == Integrator::implicit_euler;
    const long steps = facts.integrator == Integrator::dopri5 ? 1 : crude ? 31400 : 314;
    const double tolerance = crude ? 1e-4 : facts.order > 2 ? 1e-10 : 1e-6;
    const double h = std::numbers::pi / 10 / static_cast<double>(steps);  // 1 ms
    Simulation simulation(model, state_at(model, 0.097, 0));
    simulation.add(spring);
    simulation.set_integrator(facts.integrator, 1e-12);
    int failed = 0;
    for (int n = 1; n <= 10; ++n) {
      for (long s = 0; s < steps; ++s) failed += !simulation.step(h).ok();
      const double turning = (n % 2 ? -1 : 1) * (0.097 - 0.01 * n);
      CHECK(std::abs(simulation.state().q[0] - turning) < tolerance);
    }
    CHECK(failed == 0);
    for (int n = 0; n < 3; ++n) simulation.step(h);
    CHECK(simulation.state().qd[0] == 0);
    const double rest = simulation.state().q[0];
    for (int n = 0; n < 1000; ++n) simulation.step(h);
    CHECK(simulation.state().q[0] == rest);
    CHECK(std::abs(rest + 0.003) < tolerance);
  }
}

TEST_CASE("a block on an incline below the friction angle comes to rest and stays bit-identical") {
  const double tilt = 0.5, friction = 1.2 * 9.81 * std::sin(tilt);
  const Model<double> model =
      slider(1, {std::cos(tilt), 0, -std::sin(tilt)}, coulomb(friction, 0.1));
  for (const IntegratorFacts& facts : all_integrators) {
    CAPTURE(std::string(facts.name));
    Simulation simulation(model, state_at(model, 0, 0.7));
    simulation.set_integrator(facts.integrator);
    const double slows = 0.2 * 9.81 * std::sin(tilt), stops = 0.7 / slows;
    while (simulation.state().t < stops + 0.01) CHECK(simulation.step(0.01).ok());
    const double rest = simulation.state().q[0];
    CHECK(std::abs(rest - 0.7 * 0.7 / 2 / slows) < (facts.order > 1 ? 1e-12 : 0.7 * 0.01));
    CHECK(simulation.state().qd[0] == 0);
    for (int n = 0; n < 1000; ++n) simulation.step(0.01);
    CHECK(simulation.state().q[0] == rest);
    CHECK(simulation.state().qd[0] == 0);
    CHECK(simulation.mechanism().dynamics.torques().coulomb[0] ==
          doctest::Approx(-9.81 * std::sin(tilt)).epsilon(1e-13));
  }
}

TEST_CASE("a block starts to slide when the force exceeds the limit of its direction") {
  const Model<double> model = slider(1, Vector3::UnitX(), coulomb(0.5, 0.25));
  for (const double sign : {1.0, -1.0})
    for (const IntegratorFacts& facts : all_integrators) {
      CAPTURE(std::string(facts.name));
      Push ramp([sign](const State<double>& x) { return sign * x.t; });
      Simulation simulation(model, State<double>(model));
      simulation.add(ramp);
      simulation.set_integrator(facts.integrator);
      const double limit = sign > 0 ? 0.5 : 0.25, h = 0.02 / 3;
      while (simulation.state().t < limit - h) {
        CHECK(simulation.step(h).ok());
        CHECK(simulation.state().q[0] == 0);
      }
      while (simulation.state().t < limit + 1) simulation.step(h);
      const double t = simulation.state().t - limit;
      const double tolerance = facts.order > 2 ? 1e-9 : facts.order == 2 ? 2e-5 : 1e-2;
      CHECK(std::abs(simulation.state().qd[0] - sign * t * t / 2) < tolerance);
      CHECK(std::abs(simulation.state().q[0] - sign * t * t * t / 6) < tolerance);
    }
}

TEST_CASE("a sticking joint is a fixed joint for the rest of the arm") {
  const auto arm = [](JointType outer, double friction) {
    ModelBuilder builder;
    const BodyInertia rod{1, {0, 0, -0.5}, Vector3(1.0 / 12, 1.0 / 12, 0.01).asDiagonal()};
    builder.add_body("upper", 0, "first", JointType::revolute, {}, Vector3::UnitY(), rod);
    builder.add_body("lower", 1, "second", outer, {Matrix3::Identity(), {0.3, 0, -1}},
                     Vector3::UnitY(), rod, coulomb(friction, friction));
    return builder.build();
  };
  const Model<double> rubs = arm(JointType::revolute, 100), fixed = arm(JointType::fixed, 0);
  for (const IntegratorFacts& facts : all_integrators) {
    CAPTURE(std::string(facts.name));
    Simulation a(rubs, state_at(rubs, 1, 0)), b(fixed, state_at(fixed, 1, 0));
    a.set_integrator(facts.integrator);
    b.set_integrator(facts.integrator);
    for (int n = 0; n < 300; ++n) {
      CHECK(a.step(0.005).ok());
      CHECK(b.step(0.005).ok());
    }
    CHECK(a.state().q[1] == 0);
    CHECK(a.state().qd[1] == 0);
    CHECK(std::abs(a.state().q[0] - b.state().q[0]) < 1e-8);
  }
}
