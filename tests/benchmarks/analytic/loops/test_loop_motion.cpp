// Motions with closed loops: group D of docs/reference/verification_cases.md, orders, energy,
// invariants of every step.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "benchmarks/analytic/mechanisms/loop_cases.h"
#include "solver/dynamics/energy_momentum.h"
#include "solver/dynamics/model_builder.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "solver/loops/loop_closure.h"
#include "solver/stepping/simulation.h"
#include "tests/support/count_allocations.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

struct Outcome {
  double error = 0, open = 0, energy = 0;
  bool ok = true;
};
Simulation simulation_of(const LoopCase& c, Integrator integrator) {
  Simulation simulation(c.model, c.start);
  if (integrator != Integrator::semi_implicit) simulation.set_integrator(integrator);
  for (const auto& source : c.sources) simulation.add(*source);
  simulation.set_loops(c.loops);
  return simulation;
}
double energy_of(const Simulation& s) {
  return kinetic_energy(s.mechanism().model(), s.state()) +
         potential_energy(s.mechanism().model(), s.state());
}
double error_of(const LoopCase& c, const Simulation& s, const LoopCase::Sample& sample) {
  const std::vector<double> values = c.read(s.state(), s.kinematics());
  double error = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    error = std::max(error, std::abs(values[i] - sample.values[i]));
  return error;
}
Outcome run(const LoopCase& c, Integrator integrator, double h, double t_end) {
  Simulation simulation = simulation_of(c, integrator);
  const double start = energy_of(simulation);
  Outcome out;
  long n = 0;
  for (const LoopCase::Sample& sample : c.reference) {
    if (sample.t > t_end) break;
    for (; n < std::lround(sample.t / h); ++n) {
      const StepReport report = simulation.step(h);
      out.ok = out.ok && report.ok();
      out.open = std::max(out.open, report.loop_position_error);
      out.energy = std::max(out.energy, std::abs(energy_of(simulation) - start));
    }
    out.error = std::max(out.error, error_of(c, simulation, sample));
  }
  return out;
}

}  // namespace

TEST_CASE("loops: all cases of group D meet their reference with rk4, closed to 1e-12") {
  for (const LoopCase& c :
       {pendulum_on_hinge(), pendulum_on_circle(), windows(2), squeezer(), bricard(),
        governor(Couplers::springs), governor(Couplers::rods), slider_crank()}) {
    CAPTURE(c.readings[0]);
    const Outcome out = run(c, Integrator::rk4, c.step, 10);
    CAPTURE(out.error);
    CHECK(out.error < c.tolerance);
    CHECK(out.open < 1e-12);
    CHECK(out.ok);
    if (c.sources.empty()) CHECK(out.energy < 1e-8);
  }
}

TEST_CASE(
    "loops: four-bars stay on their branch whatever the step, however near they come to 90 deg") {
  const LoopCase c = windows(2);
  double nearest = 1;
  for (int i = 0; i < 8; ++i) {
    Simulation simulation = simulation_of(c, Integrator::rk4);
    const long steps = 5000 + 7 * i;
    for (long n = 0; n < steps; ++n) {
      CHECK(simulation.step(10.0 / static_cast<double>(steps)).ok());
      const std::vector<double>& q = simulation.state().q;
      CHECK(std::abs(q[0] - q[2]) + std::abs(q[0] + q[1]) < 1e-7);
      nearest = std::min(nearest, std::abs(std::cos(q[0])));
    }
    CHECK(error_of(c, simulation, c.reference[1]) < 1e-6);
  }
  CHECK(nearest < 1e-3);
}

TEST_CASE("loops: order of all integrators on the slider-crank, and of rk4 on the four-bars") {
  const LoopCase c = slider_crank();
  for (const IntegratorFacts& facts : all_integrators) {
    if (facts.integrator == Integrator::dopri5) continue;
    CAPTURE(std::string(facts.name));
    const double h = facts.order > 2 ? 2e-3 : facts.order > 1 ? 1e-3 : 2.5e-4;
    const Outcome coarse = run(c, facts.integrator, h, 1),
                  fine = run(c, facts.integrator, h / 2, 1);
    CAPTURE(coarse.error);
    CAPTURE(fine.error);
    CHECK(std::log2(coarse.error / fine.error) == doctest::Approx(facts.order).epsilon(0.1));
    CHECK(fine.open < 1e-12);
    CHECK(fine.ok);
  }
  const LoopCase d = windows(2);
  const double ratio =
      run(d, Integrator::rk4, 0.01, 1).error / run(d, Integrator::rk4, 0.005, 1).error;
  CHECK(std::log2(ratio) == doctest::Approx(4).epsilon(0.1));
}

TEST_CASE("loops: dopri5 meets its tolerance on Bricard's mechanism and on the slider-crank") {
  const LoopCase bricards = bricard(), crank = slider_crank();
  CHECK(run(bricards, Integrator::dopri5, 0.05, 10).error < 1e-6);
  CHECK(run(crank, Integrator::dopri5, 0.05, 2).error < 1e-6);
}

TEST_CASE("loops: Bricard's mechanism, closed to 1e-8, conserves energy over two minutes") {
  const LoopCase c = bricard();
  Simulation simulation = simulation_of(c, Integrator::rk4);
  const double start = energy_of(simulation);
  double open = 0, energy = 0;
  for (int n = 0; n < 60000; ++n) {
    open = std::max(open, simulation.step(2e-3).loop_position_error);
    if (n % 10 == 0) energy = std::max(energy, std::abs(energy_of(simulation) - start));
  }
  CHECK(open < 1e-12);
  CHECK(energy < 1e-8);
}

TEST_CASE("loops: a four-bar with a prescribed crank returns to its start") {
  ModelBuilder builder;
  const auto bar = [](double l) {
    return BodyInertia{1, {l / 2, 0, 0}, l * l / 12 * Matrix3::Identity()};
  };
  const Vector3 axis = -Vector3::UnitY();
  builder.add_body("crank", 0, "A", JointType::prescribed, {}, axis, bar(0.1));
  builder.add_body("coupler", 1, "B", JointType::revolute, {Matrix3::Identity(), {0.1, 0, 0}}, axis,
                   bar(0.35));
  builder.add_body("rocker", 0, "D", JointType::revolute, {Matrix3::Identity(), {0.4, 0, 0}}, axis,
                   bar(0.3));
  const Model<double> model = builder.build();
  const LoopCase c = four_bar();
  const State<double> assembled = close_loops(c.model, c.loops, c.start);
  State<double> x(model);
  x.qd = {c.reference[0].values[2] - 10, c.reference[0].values[3]};
  x.q[model.iq[2]] = assembled.q[1], x.q[model.iq[3]] = assembled.q[2];
  Simulation simulation(model, x);
  simulation.set_integrator(Integrator::rk4);
  simulation.prescribe(1, [](double t) {
    PrescribedMotion motion;
    motion.X_JL.R =
        Eigen::AngleAxisd(std::numbers::pi / 3 + 10 * t, -Vector3::UnitY()).toRotationMatrix();
    motion.angular_velocity = -10 * Vector3::UnitY();
    return motion;
  });
  simulation.set_loops({c.loops[0]});
  CHECK(std::abs(simulation.state().qd[0] - x.qd[0]) < 1e-12);  // they were consistent
  const double turn = 2 * std::numbers::pi / 10;
  for (int n = 0; n < 1000; ++n) CHECK(simulation.step(turn / 1000).ok());
  CHECK(std::abs(simulation.state().q[model.iq[3]] - x.q[model.iq[3]]) < 1e-9);
  CHECK(std::abs(simulation.state().qd[1] - x.qd[1]) < 1e-8);
}

TEST_CASE("loops: a slightly open start is assembled; one that cannot be closed is an error") {
  LoopCase c = slider_crank();
  c.start.q[0] = 0.3;  // the end of the rod is off the piston
  CHECK_THROWS_AS(simulation_of(c, Integrator::rk4), InputError);
  const State<double> closed = close_loops(c.model, c.loops, c.start);
  CHECK_NOTHROW(Simulation(c.model, closed).set_loops(c.loops));
  CHECK(std::abs(closed.q[0] - 0.3) < 0.3);
  c.loops[0].X_LbC.p.z() = 5;
  std::string what;
  try {
    close_loops(c.model, c.loops, c.start);
  } catch (const InputError& e) {
    what = e.what();
  }
  CHECK(what.find("loop 'wrist': position error is ") == 0);
}

TEST_CASE("loops: a state that opens a loop is rejected, and the run continues unchanged") {
  const LoopCase c = slider_crank();
  Simulation simulation = simulation_of(c, Integrator::rk4);
  State<double> open = c.start;
  open.q[2] += 1e-3;
  CHECK_THROWS_AS(simulation.set_state(open), InputError);
  CHECK(simulation.state().q == c.start.q);
  State<double> moving = c.start;
  moving.qd = {5, 0, 0};  // as after an impact: only the admissible part remains
  simulation.set_state(moving);
  LoopClosures loops(c.model, c.loops);
  loops.evaluate(simulation.state(), simulation.kinematics());
  CHECK(loops.rate().norm() < 1e-13);
  CHECK(kinetic_energy(c.model, simulation.state()) < kinetic_energy(c.model, moving));
}

TEST_CASE("loops: gear, locked, weld and ball remain closed with every integrator") {
  ModelBuilder builder;
  const BodyInertia cube{1, {0.1, 0, 0.05}, 0.02 * Matrix3::Identity()};
  builder.add_body("a", 0, "ja", JointType::revolute, {}, Vector3::UnitY(), cube);
  builder.add_body("b", 0, "jb", JointType::prismatic, {}, Vector3::UnitZ(), cube);
  builder.add_body("c", 1, "jc", JointType::revolute, {}, Vector3(1, 1, 0), cube);
  builder.add_body("d", 0, "jd", JointType::free, {}, Vector3::UnitZ(), cube);
  builder.add_body("e", 4, "je", JointType::spherical, {Matrix3::Identity(), {0.2, 0, 0}},
                   Vector3::UnitZ(), cube);
  const Model<double> model = builder.build();
  std::vector<LoopClosure> loops{{"gear", LoopType::gear, 1, 2},
                                 {"locked", LoopType::locked, 3},
                                 {"weld", LoopType::weld, 4, 3},
                                 {"ball", LoopType::ball, 5, 3}};
  loops[0].ratio = 3;
  loops[3].X_LaC.p = {0.1, 0, 0};
  loops[3].X_LbC.p = {0.3, 0, 0};
  for (const IntegratorFacts& facts : all_integrators) {
    CAPTURE(std::string(facts.name));
    Simulation simulation(model, State<double>(model));
    simulation.set_integrator(facts.integrator);
    simulation.set_loops(loops);
    for (int n = 0; n < 300; ++n) {
      const StepReport report = simulation.step(2e-3);
      CHECK(report.ok());
      CHECK(report.loop_position_error < 1e-12);
    }
    const State<double>& x = simulation.state();
    CHECK(std::abs(x.qd[1]) > 0.1);
    CHECK(std::abs(x.q[0] - 3 * x.q[1]) < 1e-13);
    CHECK(std::abs(x.qd[2]) < 1e-12);
  }
}

TEST_CASE(
    "loops: a step takes nothing from the heap and gives the same bits; so does a side step") {
  for (const LoopCase& c : {bricard(), windows(2), slider_crank()})
    for (const IntegratorFacts& facts : all_integrators) {
      CAPTURE(std::string(facts.name));
      LoopCase with_friction = c;
      for (double& f : with_friction.model.coulomb_plus) f = 0.05;
      for (double& f : with_friction.model.coulomb_minus) f = 0.05;
      Simulation one = simulation_of(with_friction, facts.integrator);
      Simulation two = simulation_of(with_friction, facts.integrator);
      CHECK(allocations_in([&] {
              for (int n = 0; n < 40; ++n) one.step(3e-3);
            }) == 0);
      for (int n = 0; n < 40; ++n) two.step(3e-3);
      const State<double> aside = side_step(two, 3e-3);
      one.step(3e-3), two.step(3e-3);
      CHECK(one.state().q == two.state().q);
      CHECK(one.state().qd == two.state().qd);
      CHECK(aside.q == two.state().q);
      // A run that starts here from the state alone has the same result.
      if (facts.integrator == Integrator::dopri5) continue;
      Simulation three = simulation_of(with_friction, facts.integrator);
      three.set_state(one.state());
      CHECK(three.state().q == one.state().q);
    }
}
