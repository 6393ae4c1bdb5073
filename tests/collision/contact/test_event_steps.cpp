// Event-driven steps: impacts and ends of sliding and sticking, located in time
// (solver/stepping/event_driven_step.h).
#include <doctest/doctest.h>
#include <cmath>

#include <stdexcept>

#include "solver/constraints/joint_limits.h"
#include "tests/collision/contact/contact_scene.h"
#include "tests/support/count_allocations.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

constexpr double kG = 9.81, kEventBall = 0.1;

ContactSurface rubbing(double friction, double restitution = 0) {
  ContactSurface s;
  s.friction = friction, s.restitution = restitution;
  return s;
}

// Falls from 1 m.
int falling_ball(ContactScene& scene, double restitution, const SimulationOptions& options = {}) {
  scene.set_gravity({0, 0, -kG});
  scene.floor(rubbing(0, restitution));
  const int ball = scene.body(Sphere{kEventBall}, 1, rubbing(0, 1), {{0, 0, 1 + kEventBall}});
  scene.begin(options).locate_events();
  return ball;
}

// Height over the floor and speed of a sphere that falls from 1 m, at t; before its last impact.
struct Flight {
  double z, v;
};
Flight bounced(double e, double t) {
  double v = std::sqrt(2 * kG), impact = v / kG;
  if (t < impact) return {1 - kG * t * t / 2, -kG * t};
  for (v *= e; t > impact + 2 * v / kG; v *= e) impact += 2 * v / kG;
  const double since = t - impact;
  return {v * since - kG * since * since / 2, v - kG * since};
}

void run_well(Simulation& simulation, double duration, double h) {
  const long steps = std::lround(duration / h);
  for (long n = 0; n < steps; ++n) CHECK(simulation.step(h).ok());
}

}  // namespace

TEST_CASE("event steps: a bouncing sphere agrees with the closed form at any step size") {
  for (const double h : {0.001, 0.07, 0.7})
    for (const double e : {0.5, 0.8, 1.0}) {
      CAPTURE(h);
      CAPTURE(e);
      ContactScene scene;
      const int ball = falling_ball(scene, e);
      double worst = 0;
      for (int n = 1; n * h < 1.3; ++n) {  // before the last impact with e = 0.5, at 1.35 s
        CHECK(scene.simulation().step(h).ok());
        const Flight wanted = bounced(e, scene.simulation().state().t);
        worst = std::max({worst, std::abs(scene.position(ball).z() - kEventBall - wanted.z),
                          std::abs(scene.velocity(ball).z() - wanted.v)});
      }
      CHECK(worst < 1e-9);
    }
}

TEST_CASE("event steps: the end of sliding is located to 1e-9") {
  ContactScene scene;
  scene.set_gravity({0, 0, -kG});
  scene.floor(rubbing(0.4));
  const Vector3 along = Vector3(0.6, 0.8, 0);
  const int block = scene.body(Box{{0.4, 0.4, 0.2}}, 2, rubbing(0.4), {{0, 0, 0.1}, 3 * along});
  scene.begin().locate_events();
  const double start = scene.energy();
  run_well(scene.simulation(), 1, 0.05);  // it stops at 0.7645 s
  const Vector3 moved = scene.position(block) - Vector3(0, 0, 0.1);
  CHECK((moved - 9 / (2 * 0.4 * kG) * along).norm() < 1e-9);
  CHECK(scene.velocity(block).norm() < 1e-9);
  REQUIRE(scene.contacts().work().size() == 1);
  const ContactWork& work = scene.contacts().work()[0];
  CHECK(work.friction == doctest::Approx(scene.energy() - start).epsilon(1e-9));
  CHECK(std::abs(work.normal) + std::abs(work.impact) < 1e-9);
}

TEST_CASE("event steps: a sliding sphere begins to roll, and loses 2/7 of its energy") {
  ContactScene scene;
  scene.set_gravity({0, 0, -kG});
  scene.floor(rubbing(0.2));
  const int ball = scene.body(Sphere{kEventBall}, 1, rubbing(0.2), {{0, 0, kEventBall}, {2, 0, 0}});
  scene.begin().locate_events();
  run_well(scene.simulation(), 1, 0.05);
  const double t = 2 * 2 / (7 * 0.2 * kG);  // end of sliding
  const double x = 2 * t - 0.1 * kG * t * t + 10 / 7.0 * (1 - t);
  CHECK(std::abs(scene.velocity(ball).x() - 10 / 7.0) < 1e-9);
  CHECK(std::abs(scene.position(ball).x() - x) < 1e-9);
  CHECK(scene.contacts().work()[0].friction == doctest::Approx(-2 * 2 / 7.0).epsilon(1e-8));
}

TEST_CASE("event steps: a pendulum falls onto its joint limit, stops, and is held by the torque") {
  ModelBuilder builder;
  builder.set_gravity({0, 0, -kG});
  builder.add_body("arm", 0, "joint", JointType::revolute, {}, Vector3::UnitY(),
                   {2, {0.3, 0, 0}, Vector3(0.01, 0.02, 0.02).asDiagonal()});
  const Model<double> model = builder.build();
  State<double> x(model);
  Simulation simulation(model, x);
  JointLimits limits(model);
  limits.add(1, -1, 0.5);
  simulation.add(limits);
  simulation.locate_events();
  run_well(simulation, 2, 0.1);
  CHECK(std::abs(simulation.state().q[0] - 0.5) < 1e-9);
  CHECK(std::abs(simulation.state().qd[0]) < 1e-9);
  CHECK(limits.limits()[0].force == doctest::Approx(-2 * kG * 0.3 * std::cos(0.5)).epsilon(1e-9));
  // all of the potential energy is lost
  CHECK(limits.limits()[0].work == doctest::Approx(-2 * kG * 0.3 * std::sin(0.5)).epsilon(1e-9));
}

TEST_CASE("event steps: a sphere that rolls in a bowl keeps its energy at any step size") {
  for (const double h : {0.001, 0.2}) {
    CAPTURE(h);
    ContactScene scene;
    scene.set_gravity({0, 0, -kG});
    scene.obstacle(SphericalCavity{1}, rubbing(1));
    scene.body(Sphere{kEventBall}, 1, rubbing(1), {{0.5, 0, -std::sqrt(0.81 - 0.25)}});
    scene.begin().locate_events();
    const double before = scene.energy();
    run_well(scene.simulation(), 2, h);
    CHECK(std::abs(scene.energy() - before) < 1e-9);
  }
}

TEST_CASE("event steps: a trial step changes nothing, and predicts the next step") {
  ContactScene scene;
  falling_ball(scene, 0.8);
  run_well(scene.simulation(), 1, 0.1);
  const State<double> before = scene.simulation().state();
  const State<double> ahead = side_step(scene.simulation(), 0.3);
  CHECK(scene.simulation().state().q == before.q);
  scene.simulation().step(0.3);
  CHECK((Eigen::Map<const Eigen::VectorXd>(ahead.q.data(), 7) -
         Eigen::Map<const Eigen::VectorXd>(scene.simulation().state().q.data(), 7))
            .norm() < 1e-9);
}

TEST_CASE("event steps: no allocation when warm") {
  ContactScene scene;
  scene.set_gravity({0, 0, -kG});
  scene.floor(rubbing(0.3, 0.9));
  scene.body(Sphere{kEventBall}, 1, rubbing(0.3, 1), {{0, 0, 0.3}, {1, 0, 0}});
  scene.body(Box{{0.2, 0.2, 0.2}}, 1, rubbing(0.3), {{2, 0, 0.1}, {0.5, 0, 0}});
  Simulation& simulation = scene.begin();
  simulation.locate_events();
  run_well(simulation, 1.5, 0.01);
  CHECK(allocations_in([&] {
          for (int n = 0; n < 20; ++n) simulation.step(0.01);
        }) == 0);
}

// EventSource::kGapRate: without it gaps would accumulate the integration error (8.8e-12 m after a
// minute here, 6.6e-13 m with it).
TEST_CASE("event steps: a held contact with a small gap closes, and rolls on along the ground") {
  ContactScene scene;
  scene.set_gravity({0, 0, -kG});
  scene.obstacle(SphericalCavity{1}, rubbing(1));
  const double hair = 5e-10;
  const Vector3 start = (0.9 - hair) * Vector3(0.6, 0, -0.8);
  const int ball = scene.body(Sphere{kEventBall}, 1, rubbing(1), {start});
  scene.begin().locate_events();
  const auto gap = [&] { return 0.9 - scene.position(ball).norm(); };
  REQUIRE(std::abs(gap() - hair) < 1e-12);
  run_well(scene.simulation(), 0.02, 0.01);
  CHECK(gap() == doctest::Approx(hair * std::exp(-2)).epsilon(0.01));
  run_well(scene.simulation(), 1, 0.1);
  CHECK(std::abs(gap()) < 3e-12);
}

TEST_CASE("event steps: with too many events the rest is one fixed step, and this is reported") {
  ContactScene scene;
  scene.set_gravity({0, 0, -kG});
  scene.floor(rubbing(0, 0.997));
  const int ball = scene.body(Sphere{kEventBall}, 1, rubbing(0, 1), {{0, 0, kEventBall + 1e-3}});
  scene.begin().locate_events();
  const double before = scene.energy();
  const StepReport report = scene.simulation().step(20);  // 4700 impacts in 9.5 s
  CHECK_FALSE(report.located);
  CHECK_FALSE(report.ok());
  CHECK(report.reached);
  CHECK(report.finite);
  CHECK(scene.simulation().state().t == 20);
  CHECK(scene.position(ball).z() > kEventBall - 1e-6);
  CHECK(scene.energy() < before + 1e-6);
  for (int n = 0; n < 5; ++n) CHECK(scene.simulation().step(0.1).ok());  // located again
}

TEST_CASE("event steps: an interrupted step ends at once in a valid state") {
  static int asked;
  ContactScene whole, parted;
  const int ball = falling_ball(whole, 0.8);
  falling_ball(parted, 0.8, {.interrupted = [] { return ++asked == 700; }});
  CHECK(whole.simulation().step(3).ok());
  asked = 0;
  const StepReport report = parted.simulation().step(3);
  CHECK(report.interrupted);
  CHECK_FALSE(report.reached);
  CHECK(asked == 700);
  const double t = parted.simulation().state().t;
  CHECK(t > 0);
  CHECK(t < 3);
  const Flight there = bounced(0.8, t);
  CHECK(std::abs(parted.position(ball).z() - kEventBall - there.z) < 1e-9);
  CHECK(parted.simulation().step(3 - t).ok());
  CHECK((parted.position(ball) - whole.position(ball)).norm() < 1e-9);
  CHECK((parted.velocity(ball) - whole.velocity(ball)).norm() < 1e-9);
}

TEST_CASE("event steps: implicit forces are rejected, in any order") {
  struct Implicit final : ForceSource {
    void add_forces(const State<double>&, const Kinematics&, Forces<double>&) noexcept override {}
    bool needs_semi_implicit() const override { return true; }
  } source;
  ContactScene scene;
  scene.body(Sphere{kEventBall}, 1, rubbing(0), {});
  Simulation& simulation = scene.begin();
  simulation.locate_events();
  CHECK_THROWS_AS(simulation.add(source), std::invalid_argument);
  ContactScene other;
  other.body(Sphere{kEventBall}, 1, rubbing(0), {});
  other.begin().add(source);
  CHECK_THROWS_AS(other.simulation().locate_events(), std::invalid_argument);
}
