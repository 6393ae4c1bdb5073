// Joint limits, damping, friction and mimic joints in constrained steps: sliders with closed-form
// solutions.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "solver/constraints/joint_limits.h"
#include "solver/dynamics/model_builder.h"
#include "solver/stepping/simulation.h"

using namespace twinarm;

namespace {

constexpr double kFar = 100, kMassOfBlock = 2;

BodyInertia block_of(double mass) {
  return {mass, Vector3::Zero(), Matrix3::Identity()};
}

// A block on a vertical rail between two limits.
struct Slider {
  Slider(double lower, double upper, double g, const JointProperties& properties = {},
         const SimulationOptions& options = {})
      : model([&] {
          ModelBuilder builder;
          builder.set_gravity({0, 0, -g});
          builder.add_body("block", 0, "rail", JointType::prismatic, {}, Vector3::UnitZ(),
                           block_of(kMassOfBlock), properties);
          return builder.build();
        }()),
        limits(model),
        simulation(model, State<double>(model), options) {
    limits.add(1, lower, upper);
    simulation.add(limits);
  }
  Slider(const Slider&) = delete;
  void start(double q, double qd) {
    State<double> x(model);
    x.q[0] = q, x.qd[0] = qd;
    simulation.set_state(x);
  }
  double q() const { return simulation.state().q[0]; }
  double qd() const { return simulation.state().qd[0]; }

  Model<double> model;
  JointLimits limits;
  Simulation simulation;
};

}  // namespace

TEST_CASE("limits: a falling block stops at the limit, whose force is its weight") {
  constexpr double h = 1e-4, g = 9.81, drop = 0.1;
  for (const double side : {1.0, -1.0}) {  // falls to the lower; thrown up by -g to the upper
    Slider s(side > 0 ? 0 : -kFar, side > 0 ? kFar : 0, side * g);
    s.start(side * drop, 0);
    const double lands = std::sqrt(2 * drop / g);
    for (int n = 1; n * h < 2 * lands; ++n) {
      REQUIRE(s.simulation.step(h).ok());
      const double t = n * h, wanted = t < lands ? drop - 0.5 * g * t * t : 0;
      CHECK(std::abs(side * s.q() - wanted) < 2e-4);  // first order: g h t / 2
      CHECK(side * s.q() > -1e-8);
    }
    CHECK(std::abs(s.qd()) < 1e-9);
    CHECK(s.limits.limits()[0].force == doctest::Approx(side * kMassOfBlock * g).epsilon(1e-6));
  }
}

TEST_CASE("limits: an impact in fixed steps dissipates the kinetic energy of the block") {
  constexpr double speed = 1.7;  // partly dissipated by the step that reaches the limit
  Slider s(0, kFar, 0);
  s.start(0.1, -speed);
  for (int n = 0; n < 100; ++n) REQUIRE(s.simulation.step(1e-3).ok());
  CHECK(std::abs(s.qd()) < 1e-9);
  const double had = 0.5 * kMassOfBlock * speed * speed;
  CHECK(s.limits.limits()[0].work == doctest::Approx(-had).epsilon(1e-9));
}

TEST_CASE("limits: an impact in event-driven steps dissipates the kinetic energy of the block") {
  constexpr double g = 9.81, drop = 0.1;
  Slider s(0, kFar, g);
  s.simulation.locate_events();
  s.start(drop, 0);
  for (int n = 0; n < 30; ++n) REQUIRE(s.simulation.step(1e-2).ok());
  CHECK(std::abs(s.q()) < 1e-8);
  CHECK(s.limits.limits()[0].work == doctest::Approx(-kMassOfBlock * g * drop).epsilon(1e-7));
}

TEST_CASE(
    "limits: one that holds a block lets its gap go by exp(-100 t), and does the work that takes") {
  constexpr double g = 9.81, h = 1e-3;
  for (const double start : {EventSource::kClosed, -10 * EventSource::kClosed}) {
    CAPTURE(start);
    Slider s(0, kFar, g);
    s.simulation.locate_events();
    s.start(start, 0);
    for (int n = 1; n <= 100; ++n) {
      REQUIRE(s.simulation.step(h).ok());
      CHECK(std::abs(s.q() - start * std::exp(-100 * n * h)) < 1e-5 * std::abs(start));
      const double gained = kMassOfBlock * (g * (s.q() - start) + 0.5 * s.qd() * s.qd());
      CHECK(std::abs(s.limits.limits()[0].work - gained) < 1e-5 * std::abs(gained));
    }
  }
}

TEST_CASE(
    "limits: what starts beyond one is pushed back without speed, a fifth of the rest a step") {
  constexpr double g = 9.81, beyond = 1e-3;
  Slider s(0, kFar, g, {}, {.enable_constraint_work = true});
  s.start(-beyond, 0);
  double work = 0, wanted = -beyond;
  for (int n = 0; n < 100; ++n) {
    REQUIRE(s.simulation.step(1e-3).ok());
    wanted *= 0.8;
    CHECK(std::abs(s.q() - wanted) < 1e-7);
    CHECK(std::abs(s.qd()) < 1e-9);
    work += s.simulation.mechanism().account->separation().work;
  }
  CHECK(work == doctest::Approx(kMassOfBlock * g * (s.q() + beyond)).epsilon(1e-9));
}

TEST_CASE("limits: side steps across an impact leave an event-driven run bit-identical") {
  constexpr double g = 9.81, drop = 0.1;
  Slider with(0, kFar, g), without(0, kFar, g);
  for (Slider* s : {&with, &without}) {
    s->simulation.locate_events();
    s->start(drop, 0);
  }
  for (int n = 0; n < 30; ++n) {
    const State<double> aside = side_step(with.simulation, 0.3);
    CHECK(std::abs(aside.q[0]) < 1e-8);  // the block rests on its limit
    REQUIRE(with.simulation.step(1e-2).ok());
    REQUIRE(without.simulation.step(1e-2).ok());
    CHECK(with.q() == without.q());
    CHECK(with.qd() == without.qd());
    CHECK(with.limits.limits()[0].work == without.limits.limits()[0].work);
  }
}

TEST_CASE("limits require a joint with one dof, and lower <= upper") {
  ModelBuilder builder;
  builder.add_body("a", 0, "ball", JointType::spherical, {}, Vector3::UnitZ(), block_of(1));
  builder.add_body("b", 1, "hinge", JointType::revolute, {}, Vector3::UnitZ(), block_of(1));
  const Model<double> model = builder.build();
  JointLimits limits(model);
  constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
  for (const int body : {-1, 0, 1, 3})
    CHECK_THROWS_WITH(limits.add(body, -1, 1),
                      "a position limit requires a joint with one degree of freedom");
  for (const double upper : {-2.0, kNotANumber})
    CHECK_THROWS_WITH(limits.add(2, -1, upper), "the lower limit is above the upper limit");
  CHECK(limits.limits().empty());
  limits.add(2, -1, -1);
  CHECK(limits.limits().size() == 1);
}

TEST_CASE("constrained steps: joint damping acts at the end of the step") {
  constexpr double h = 1e-2, b = 7, v0 = 3;
  JointProperties damped;
  damped.damping = b;
  Slider s(-kFar, kFar, 0, damped);
  s.start(0, v0);
  double v = v0;
  for (int n = 0; n < 50; ++n) {
    REQUIRE(s.simulation.step(h).ok());
    v /= 1 + h * b / kMassOfBlock;  // m (v' - v) = -h b v'
    CHECK(s.qd() == doctest::Approx(v).epsilon(1e-12));
  }
}

TEST_CASE("constrained steps: joint friction decelerates by F / m, then sticks below its limit") {
  constexpr double h = 1e-3, F = 3;
  JointProperties rubbing;
  rubbing.coulomb_plus = rubbing.coulomb_minus = F;
  for (const double side : {1.0, -1.0}) {
    Slider s(-kFar, kFar, 0, rubbing);
    s.start(0, side);
    for (int n = 1; n < 1000; ++n) {
      REQUIRE(s.simulation.step(h).ok());
      CHECK(std::abs(side * s.qd() - std::max(0.0, 1 - n * h * F / kMassOfBlock)) < 1e-9);
    }
  }
  for (const double g : {1.0, 2.0}) {  // pulled by m g = 2 N, and by 4 N
    Slider s(-kFar, kFar, g, rubbing);
    for (int n = 1; n < 100; ++n) {
      REQUIRE(s.simulation.step(h).ok());
      CHECK(std::abs(s.qd() + n * h * std::max(0.0, g - F / kMassOfBlock)) < 1e-9);
      CHECK(s.simulation.constraints().coulomb_torque()[0] ==
            doctest::Approx(std::min(F, kMassOfBlock * g)).epsilon(1e-6));
    }
    Slider without(-kFar, kFar, g, rubbing, {.joint_friction = false});
    without.simulation.step(h);
    CHECK(without.qd() == doctest::Approx(-g * h).epsilon(1e-12));
  }
}

// Mimic joint q_f = -2 q_l: side by side, or on the mimicked joint. With the
// speeds s_i q_l' of both blocks, a = -g sum(m_i s_i) / sum(m_i s_i^2).
TEST_CASE(
    "under constraints who follows follows, without work, until the leader's limit stops both") {
  constexpr double g = 9.81, m_l = 1, m_f = 3, end = 0.05;
  for (const bool carried : {false, true})
    for (const bool located : {false, true}) {
      CAPTURE(carried);
      CAPTURE(located);
      ModelBuilder builder;
      builder.add_body("l", 0, "leader", JointType::prismatic, {}, Vector3::UnitZ(), block_of(m_l));
      builder.add_body("f", carried ? 1 : 0, "follower", JointType::prismatic, {}, Vector3::UnitZ(),
                       block_of(m_f));
      builder.add_mimic("follower", "leader", -2, 0);
      const Model<double> model = builder.build();
      JointLimits limits(model);
      limits.add(1, -kFar, end);
      Simulation simulation(model, State<double>(model), {.enable_constraint_work = true});
      simulation.add(limits);
      if (located) simulation.locate_events();
      const double s_f = carried ? -1 : -2;
      const double a = -g * (m_l + m_f * s_f) / (m_l + m_f * s_f * s_f);
      REQUIRE(a > 0);
      const double h = 1e-3, lands = std::sqrt(2 * end / a);
      for (int n = 1; n < 400; ++n) {
        REQUIRE(simulation.step(h).ok());
        const State<double>& x = simulation.state();
        const double t = n * h;
        if (t < lands - h) CHECK(x.qd[0] == doctest::Approx(a * t).epsilon(1e-9));
        if (t > lands + h) {
          CHECK(std::abs(x.qd[0]) < 1e-8);
          CHECK(std::abs(x.q[0] - end) < (located ? 1e-8 : 1e-7));
        }
        CHECK(std::abs(x.q[1] + 2 * x.q[0]) < 1e-9);
        CHECK(std::abs(x.qd[1] + 2 * x.qd[0]) < 1e-9);
        CHECK(std::abs(simulation.mechanism().account->mimics()[0]) < 1e-9);
      }
    }
}

TEST_CASE("a constraint source without constraints makes steps constrained") {
  ModelBuilder builder;
  builder.add_body("body", 0, "free", JointType::free, {}, Vector3::UnitZ(),
                   {1, Vector3(0.1, 0, 0), Vector3(1, 2, 3).asDiagonal()});
  const Model<double> model = builder.build();
  State<double> x(model);
  x.qd = {3, 20, 1, 1, 2, 3};
  JointLimits none(model);
  Simulation constrained(model, x), plain(model, x);
  constrained.add(none);
  CHECK_THROWS_AS(constrained.set_integrator(Integrator::rk4), std::invalid_argument);
  for (int n = 0; n < 100; ++n)
    for (Simulation* simulation : {&constrained, &plain}) REQUIRE(simulation->step(1e-3).ok());
  CHECK(constrained.state().q != plain.state().q);
}
