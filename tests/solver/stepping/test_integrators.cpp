// Integrators: names, invariants, long-term behaviour, reported failures.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <string>

#include "solver/dynamics/model_builder.h"
#include "tests/solver/stepping/pendulum.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

#ifdef NDEBUG
constexpr int kManySteps = 1000000;
#else
constexpr int kManySteps = 100000;  // sanitizers are slow
#endif

// A torque about the pendulum's joint as function of angle and rate.
template <class Law>
struct HingeTorque final : ForceSource, Checkpointable {
  Law law;
  explicit HingeTorque(Law l) : law(l) {}
  void add_forces(const State<double>& x, const Kinematics&,
                  Forces<double>& forces) noexcept override {
    forces.tau[0] += law(x.q[0], x.qd[0]);
  }
};

// One rotating body of 1 kg m^2 without gravity.
Model<double> wheel() {
  ModelBuilder builder;
  builder.add_body("wheel", 0, "axle", JointType::revolute, {}, Vector3::UnitZ(),
                   {1.0, Vector3::Zero(), Matrix3::Identity()});
  return builder.build();
}

}  // namespace

TEST_CASE("every integrator is found by its name, in the order of the list") {
  const char* names[] = {
      "euler",  "semi-implicit",  "semi-implicit-xv",  "verlet",   "midpoint", "heun", "rk4",
      "dopri5", "implicit-euler", "implicit-midpoint", "trapezoid"};
  REQUIRE(std::size(names) == all_integrators.size());
  for (std::size_t n = 0; n < all_integrators.size(); ++n) {
    const Integrator integrator = all_integrators[n].integrator;
    CHECK(static_cast<std::size_t>(integrator) == n);
    CHECK(std::string(integrator_name(integrator)) == names[n]);
    CHECK(find_integrator(names[n]) == integrator);
  }
  CHECK_FALSE(find_integrator("rk5"));
  CHECK_FALSE(find_integrator(""));
}

TEST_CASE("oscillator: both semi-implicit methods conserve x'^2 + w^2 x^2 -+ h w^2 x x' exactly") {
  const Model<double> model = wheel();
  const double w2 = 9, h = 0.05;
  for (const Integrator integrator : {Integrator::semi_implicit, Integrator::semi_implicit_xv}) {
    HingeTorque spring([&](double q, double) { return -w2 * q; });
    Simulation simulation(model, state_at(model, 1, 0.5));
    simulation.add(spring);
    simulation.set_integrator(integrator);
    const double sign = integrator == Integrator::semi_implicit ? -1 : 1;
    const auto kept = [&] {
      const double x = simulation.state().q[0], v = simulation.state().qd[0];
      return v * v + w2 * x * x + sign * h * w2 * x * v;
    };
    const double start = kept();
    double worst = 0;
    for (int n = 0; n < 100000; ++n) {
      simulation.step(h);
      worst = std::max(worst, std::abs(kept() - start));
    }
    CHECK(worst < 1e-11 * start);
  }
}

TEST_CASE("a pendulum's energy has no trend over 1e6 steps of the symplectic methods") {
  // Windowed means without the oscillation: first and last tenth.
  constexpr int kSteps = kManySteps, kWindow = kSteps / 10;
  const Model<double> model = pendulum();
  for (const Integrator integrator :
       {Integrator::semi_implicit, Integrator::semi_implicit_xv, Integrator::verlet}) {
    CAPTURE(std::string(integrator_name(integrator)));
    Simulation simulation(model, state_at(model, kRight, 0));
    simulation.set_integrator(integrator);
    double first = 0, last = 0, weight = 0, worst = 0;
    for (int n = 0; n < kSteps; ++n) {
      const double q = simulation.state().q[0], qd = simulation.state().qd[0];
      const double energy = 0.5 * qd * qd - 9.81 * std::cos(q);
      worst = std::max(worst, std::abs(energy));
      const int in_window = n < kWindow ? n : n - (kSteps - kWindow);
      if (in_window >= 0) {
        const double bell = std::pow(std::sin(std::numbers::pi * in_window / kWindow), 6);
        (n < kWindow ? first : last) += bell * energy;
        if (n < kWindow) weight += bell;
      }
      simulation.step(0.01);
    }
    CHECK(std::abs(last - first) / weight < 1e-12 * (kSteps - kWindow));
    CHECK(worst < (integrator == Integrator::verlet ? 0.01 : 0.3));
  }
}

TEST_CASE("a rotating body: exact under every integrator, unit quaternion after 1e6 steps") {
  const Model<double> model =
      free_body({1, Vector3::Zero(), Vector3(1, 2, 3).asDiagonal()}, Vector3::Zero());
  State<double> start(model);
  start.qd[2] = 2;  // about a principal axis
  const auto turn = [](const State<double>& x) {
    return Eigen::Quaterniond(x.q[3], x.q[4], x.q[5], x.q[6]);
  };
  for (const IntegratorFacts& facts : all_integrators) {
    CAPTURE(std::string(facts.name));
    const State<double> x = run(model, start, facts.integrator, 0.01, 1000);
    const Eigen::Quaterniond exact(Eigen::AngleAxisd(20, Vector3::UnitZ()));
    CHECK(turn(x).angularDistance(exact) < 1e-12);
  }
  start.qd[0] = 1;
  start.qd[1] = 5;  // tumbling
  const State<double> x = run(model, start, Integrator::verlet, 0.001, kManySteps);
  CHECK(std::abs(turn(x).norm() - 1) < 1e-12);
}

TEST_CASE("free fall is exact to rounding under every method of order 2 and higher") {
  const Model<double> model =
      free_body({2, Vector3::Zero(), Vector3(0.1, 0.2, 0.25).asDiagonal()}, {0, 0, -9.81});
  State<double> start(model);
  start.q[2] = 1;
  start.qd = {0, 0, 0, 3, 0, 4};
  for (const IntegratorFacts& facts : all_integrators) {
    if (facts.order < 2) continue;
    CAPTURE(std::string(facts.name));
    const State<double> x = run(model, start, facts.integrator, 0.015, 100);
    CHECK(std::abs(x.q[0] - 4.5) < 1e-12);
    CHECK(std::abs(x.q[1]) < 1e-12);
    CHECK(std::abs(x.q[2] + 4.03625) < 1e-12);
  }
}

TEST_CASE("implicit methods satisfy their recurrences on a spring with omega h = 100 to 1e-12") {
  const Model<double> model = wheel();
  const double k = 1e8, b = 1e3, h = 0.01;
  for (const IntegratorFacts& facts : all_integrators) {
    if (!facts.solves) continue;
    CAPTURE(std::string(facts.name));
    HingeTorque spring([&](double q, double qd) { return -k * q - b * qd; });
    Simulation simulation(model, state_at(model, 1e-3, 0));
    simulation.add(spring);
    simulation.set_integrator(facts.integrator);
    double x = 1e-3, v = 0;
    for (int n = 0; n < 100; ++n) {
      const StepReport report = simulation.step(h);
      CHECK(report.converged);
      CHECK(report.iterations <= 6);
      // Linear: u = (v + reach a0) / (1 + reach b + reach^2 k), and so on.
      if (facts.integrator == Integrator::implicit_euler) {
        v = (v - h * k * x) / (1 + h * b + h * h * k);
        x += h * v;
      } else {  // on a linear system midpoint and trapezoid are one
        const double u = (v - h / 2 * k * x) / (1 + h / 2 * b + h * h / 4 * k);
        x += h * u;
        v = 2 * u - v;
      }
      CHECK(std::abs(simulation.state().q[0] - x) < 1e-12 * 1e-3);
      CHECK(std::abs(simulation.state().qd[0] - v) < 1e-12 * 1e-3 * std::sqrt(k));
    }
  }
}

TEST_CASE("an implicit step without solution reports converged = false") {
  const Model<double> model = wheel();
  for (const IntegratorFacts& facts : all_integrators) {
    if (!facts.solves) continue;
    CAPTURE(std::string(facts.name));
    // A discontinuous torque: no velocity solves the step.
    HingeTorque dry([](double, double qd) { return qd > 0.001 ? -100.0 : 50.0; });
    Simulation simulation(model, state_at(model, 0, 0));
    simulation.add(dry);
    simulation.set_integrator(facts.integrator);
    const StepReport report = simulation.step(0.01);
    CHECK_FALSE(report.converged);
    CHECK_FALSE(report.ok());
    CHECK(report.finite);
    CHECK(report.iterations > 1);
  }
}

TEST_CASE("dopri5 reports reached = false if no substep meets the tolerance") {
  const Model<double> model = wheel();
  HingeTorque runaway([](double, double qd) { return qd * qd; });  // qd = 1 / (1 - t)
  Simulation simulation(model, state_at(model, 0, 1));
  simulation.add(runaway);
  simulation.set_integrator(Integrator::dopri5);
  const StepReport report = simulation.step(2);
  CHECK_FALSE(report.reached);
  CHECK_FALSE(report.ok());
  CHECK(simulation.state().t == doctest::Approx(1).epsilon(1e-6));
  CHECK(report.h == simulation.state().t);
}

TEST_CASE("dopri5 by substeps is bit-identical to one step, each within its limit") {
  const Model<double> model = pendulum();
  const auto start = [&] {
    Simulation simulation(model, state_at(model, kRight, 0));
    simulation.set_integrator(Integrator::dopri5, 1e-8);
    return simulation;
  };
  Simulation whole = start(), parts = start();
  const StepReport report = whole.step(3);
  int substeps = 0;
  while (parts.state().t < 3) {
    const StepReport part = parts.step(3 - parts.state().t, true);
    CHECK(part.substeps == 1);
    CHECK(part.h > 0);
    ++substeps;
  }
  CHECK(substeps == report.substeps);
  CHECK(whole.state().q[0] == parts.state().q[0]);
  CHECK(whole.state().qd[0] == parts.state().qd[0]);
  Simulation limited = start();
  CHECK(limited.step(1e-3, true).h == 1e-3);
}
