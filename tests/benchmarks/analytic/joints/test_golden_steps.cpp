// Fixed-step integrators against the golden numbers of an independent code (docs/reference/verification_cases.md, G1),
// which tell at once where an integrator bears another's name; and the order of each, on mechanisms
// whose forces depend on velocity (C2) and whose coordinates are rotations (A2, A4).
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <string>

#include "benchmarks/analytic/joints/golden_steps.h"
#include "solver/dynamics/model_builder.h"
#include "tests/solver/stepping/pendulum.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

constexpr double kExactAngle = -1.4050273115247991;  // t = 1 s, released at 90 degrees

// A mechanism, where it starts, and what is known of it after a time.
struct Case {
  std::string name;
  Model<double> model;
  State<double> start;
  double time;
  double h;  // of a method of order 1; n times as long for one of order n
  std::vector<double> exact;
  std::vector<double> (*known)(const State<double>&);

  double error(const State<double>& x) const {
    const std::vector<double> here = known(x);
    double largest = 0;
    for (std::size_t i = 0; i < exact.size(); ++i)
      largest = std::max(largest, std::abs(here[i] - exact[i]));
    return largest;
  }
};

Case double_pendulum_of_rods() {  // C2
  ModelBuilder builder;
  const BodyInertia rod{1, {0, 0, -0.5}, Vector3(1.0 / 12, 1.0 / 12, 0).asDiagonal()};
  builder.add_body("upper", 0, "first", JointType::revolute, {}, Vector3::UnitY(), rod);
  builder.add_body("lower", 1, "second", JointType::revolute, {Matrix3::Identity(), {0, 0, -1}},
                   Vector3::UnitY(), rod);
  Case c{"double pendulum",
         builder.build(),
         {},
         1,
         0.001,
         {-1.207716238190638, 0.39332521509934164, -3.4065175329719578, 2.8904720608667489},
         [](const State<double>& x) -> std::vector<double> {
           return {x.q[0], x.q[1], x.qd[0], x.qd[1]};
         }};
  c.start = State<double>(c.model);
  c.start.q[0] = kRight;
  return c;
}

Case tumbling_body() {  // A2
  const BodyInertia body{1, Vector3::Zero(), Vector3(1, 2, 3).asDiagonal()};
  Case c{"tumbling body",
         free_body(body, Vector3::Zero()),
         {},
         1,
         0.01,
         {0.77903960258822208, 0.35820926595727759, 0.1958299706947999, 0.4758508610470377,
          0.57780247181207994, 0.81617663747981084, 0.88201581551053634},
         [](const State<double>& x) -> std::vector<double> {
           return {x.q[3], x.q[4], x.q[5], x.q[6], x.qd[0], x.qd[1], x.qd[2]};
         }};
  c.start = State<double>(c.model);
  c.start.qd = {1, 0, 1, 0, 0, 0};
  return c;
}

Case heavy_top() {  // A4, cuspidal
  ModelBuilder builder;
  builder.add_body("top", 0, "tip", JointType::spherical, {}, Vector3::UnitZ(),
                   {1, {0, 0, 0.2}, Vector3(0.01, 0.01, 0.01).asDiagonal()});
  Case c{"heavy top",
         builder.build(),
         {},
         0.1,
         2.5e-4,
         {0.055278084493223518, -0.5595760404157726, 0.82693348485072587, -1.5958918736038487,
          -0.72184688520695026, 100},
         [](const State<double>& x) -> std::vector<double> {
           const Vector3 axis =
               Eigen::Quaterniond(x.q[0], x.q[1], x.q[2], x.q[3]) * Vector3::UnitZ();
           return {axis.x(), axis.y(), axis.z(), x.qd[0], x.qd[1], x.qd[2]};
         }};
  c.start = State<double>(c.model);
  c.start.q[0] = std::cos(kRight / 6);  // half of 30 degrees about x
  c.start.q[1] = std::sin(kRight / 6);
  c.start.qd[2] = 100;
  return c;
}

}  // namespace

TEST_CASE("a pendulum from 90 degrees, 100 steps of 10 ms, meets the golden numbers to 1e-12") {
  CHECK(std::size(golden_steps()) == all_integrators.size() - 1);  // dopri5 has no fixed step
  for (const GoldenSteps& row : golden_steps()) {
    CAPTURE(std::string(integrator_name(row.integrator)));
    const State<double> x = swing(kRight, 0, row.integrator, 0.01, 1);
    CHECK(std::abs(x.q[0] - row.angle) < 1e-12);
    CHECK(std::abs(x.qd[0] - row.rate) < 1e-12);
    CHECK(std::abs(x.t - 1) < 1e-12);
  }
}

TEST_CASE("a pendulum's errors at three steps, and its energy after 100 s, are the golden ones") {
  for (const GoldenSteps& row : golden_steps()) {
    CAPTURE(std::string(integrator_name(row.integrator)));
    double h = 0.01;
    for (const double error : row.error) {
      const double angle = swing(kRight, 0, row.integrator, h, 1).q[0];
      CHECK(std::abs(angle - kExactAngle) == doctest::Approx(error).epsilon(1e-3));
      h /= 2;
    }
    const State<double> x = swing(kRight, 0, row.integrator, 0.01, 100);
    const double energy = 0.5 * x.qd[0] * x.qd[0] - 9.81 * std::cos(x.q[0]);
    CHECK(energy == doctest::Approx(row.energy).epsilon(1e-3));
  }
}

TEST_CASE("the error falls as h^order when h halves four times, for every integrator") {
  for (const Case& c : {double_pendulum_of_rods(), tumbling_body(), heavy_top()})
    for (const IntegratorFacts& facts : all_integrators) {
      if (facts.integrator == Integrator::dopri5) continue;
      CAPTURE(c.name);
      CAPTURE(std::string(facts.name));
      const auto error = [&](long steps) {
        const double h = c.time / static_cast<double>(steps);
        return c.error(run(c.model, c.start, facts.integrator, h, steps));
      };
      const long steps = std::lround(c.time / (c.h * facts.order));
      CHECK(std::abs(std::log2(error(steps) / error(16 * steps)) / 4 - facts.order) < 0.1);
    }
}

TEST_CASE("dopri5: the error is proportional to the tolerance over four decades") {
  for (const Case& c : {double_pendulum_of_rods(), tumbling_body(), heavy_top()}) {
    CAPTURE(c.name);
    double least = 1e300, most = 0;
    for (const double tolerance : {1e-6, 1e-7, 1e-8, 1e-9, 1e-10}) {
      Simulation simulation(c.model, c.start);
      simulation.set_integrator(Integrator::dopri5, tolerance);
      CHECK(simulation.step(c.time).ok());
      const double error = c.error(simulation.state());
      least = std::min(least, error / tolerance);
      most = std::max(most, error / tolerance);
    }
    CHECK(most < 2 * least);
    CHECK(most < 50);
  }
}
