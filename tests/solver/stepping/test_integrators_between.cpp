// Side steps and set_state().
#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

#include "solver/model/configuration.h"
#include "solver/stepping/simulation.h"
#include "tests/solver/dynamics/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

const std::vector<JointType> kJoints{JointType::revolute, JointType::prismatic, JointType::free};

struct Implicit final : ForceSource {
  void add_forces(const State<double>&, const Kinematics&,
                  Forces<double>& forces) noexcept override {
    forces.armature[0] += 1;
  }
  bool needs_semi_implicit() const override { return true; }
};

// A torque that grows with every begin_step(): internal state.
struct Counter final : ForceSource, Checkpointable {
  int steps = 0;
  void begin_step(const Kinematics&, double, double) noexcept override { ++steps; }
  void add_forces(const State<double>&, const Kinematics&,
                  Forces<double>& forces) noexcept override {
    forces.tau.back() += 0.01 * steps;
  }
  void serialize(StateArchive& memory) override { memory.visit(steps); }
};

}  // namespace

TEST_CASE("semi-implicit-xv is semi-implicit shifted by a drift, with implicit sources") {
  Random random(11);
  const Model<double> model = random_tree(random, 6, kJoints);
  const State<double> start = random_state(random, model);
  Implicit source_a, source_b;
  Simulation vx(model, start), xv(model, start);
  vx.add(source_a);
  xv.add(source_b);
  xv.set_integrator(Integrator::semi_implicit_xv);
  // After a drift by h the one is at the start of the other's step.
  State<double> drifted = start;
  std::vector<double> shift(start.qd);
  for (double& s : shift) s *= 1e-3;
  integrate_coordinates(model, start.q, shift, drifted.q);
  drifted.t = 1e-3;
  vx.set_state(drifted);
  for (int n = 0; n < 100; ++n) {
    const State<double> before = vx.state();
    vx.step(1e-3);
    xv.step(1e-3);
    CHECK(xv.state().q == before.q);
    CHECK(xv.state().qd == vx.state().qd);
    CHECK(xv.state().t == before.t);
  }
}

TEST_CASE("a side step gives the result of a step and leaves the run bit-identical") {
  Random random(12);
  const Model<double> model = random_tree(random, 6, kJoints);
  const State<double> start = random_state(random, model);
  for (const IntegratorFacts& facts : all_integrators) {
    CAPTURE(std::string(facts.name));
    Counter counted, alone, short_step;
    Simulation looked_at(model, start), left_alone(model, start);
    looked_at.add(counted);
    left_alone.add(alone);
    looked_at.set_integrator(facts.integrator);
    left_alone.set_integrator(facts.integrator);
    for (int n = 0; n < 20; ++n) {
      const State<double> from = looked_at.state();
      const State<double> aside = side_step(looked_at, 3e-4);
      CHECK(aside.t == from.t + 3e-4);
      CHECK(looked_at.state().q == from.q);
      CHECK(looked_at.state().qd == from.qd);
      if (n == 0) {
        Simulation really(model, start);
        really.add(short_step);
        really.set_integrator(facts.integrator);
        really.step(3e-4);
        CHECK(really.state().q == aside.q);
        CHECK(really.state().qd == aside.qd);
      }
      looked_at.step(1e-3);
      left_alone.step(1e-3);
    }
    CHECK(looked_at.state().q == left_alone.state().q);
    CHECK(looked_at.state().qd == left_alone.state().qd);
    CHECK(counted.steps == 20);
  }
}

// A prescribed motion must not throw; it stands for memory that runs out.
TEST_CASE("a side step that ends by an exception leaves the sources unchanged") {
  ModelBuilder builder;
  const BodyInertia inertia{1, Vector3::Zero(), Matrix3::Identity()};
  builder.add_body("hand", 0, "held", JointType::prescribed, {}, Vector3::UnitZ(), inertia);
  builder.add_body("block", 0, "rail", JointType::prismatic, {}, Vector3::UnitZ(), inertia);
  const Model<double> model = builder.build();
  Counter counter;
  Simulation simulation(model, State<double>(model));
  simulation.add(counter);
  simulation.prescribe(1, [](double t) {
    if (t > 0.01) throw std::runtime_error("too late");
    return PrescribedMotion{};
  });
  simulation.step(5e-3);
  CHECK(counter.steps == 1);
  CHECK_THROWS_AS(side_step(simulation, 0.1), std::runtime_error);
  CHECK(counter.steps == 1);
}

TEST_CASE("side_step() rejects sources that are not Checkpointable") {
  Random random(13);
  const Model<double> model = random_tree(random, 2, kJoints);
  Implicit source;
  Simulation simulation(model, State<double>(model));
  CHECK_NOTHROW(side_step(simulation, 1e-3));
  simulation.add(source);
  CHECK_THROWS_AS(side_step(simulation, 1e-3), std::invalid_argument);
}

TEST_CASE(
    "a run that is set to another's state goes on as the other, and wrong sizes are refused") {
  Random random(14);
  const Model<double> model = random_tree(random, 5, kJoints);
  for (const IntegratorFacts& facts : all_integrators) {
    CAPTURE(std::string(facts.name));
    Simulation one(model, random_state(random, model));
    Simulation two(model, State<double>(model));
    one.set_integrator(facts.integrator);
    two.set_integrator(facts.integrator);
    one.step(1e-3);
    one.set_state(one.state());  // resets the substep size of dopri5
    two.set_state(one.state());
    CHECK(two.kinematics().X_WL[5].p == one.kinematics().X_WL[5].p);
    one.step(1e-3);
    two.step(1e-3);
    CHECK(one.state().q == two.state().q);
    CHECK(one.state().qd == two.state().qd);
    CHECK(one.state().t == two.state().t);
    CHECK_THROWS_AS(two.set_state(State<double>()), std::invalid_argument);
  }
}
