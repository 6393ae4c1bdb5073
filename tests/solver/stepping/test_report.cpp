// Reports and exceptions for failing and incompatible sources.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "solver/constraints/joint_limits.h"
#include "solver/dynamics/dynamics.h"
#include "solver/stepping/simulation.h"
#include "solver/support/diagnostics.h"
#include "tests/solver/dynamics/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

struct ConstantTorque final : ForceSource {
  std::size_t velocity = 0;
  double value = 0;
  bool implicit = false;
  void add_forces(const State<double>&, const Kinematics&, Forces<double>& f) noexcept override {
    f.tau[velocity] += value;
  }
  bool needs_semi_implicit() const override { return implicit; }
};

Model<double> chain(int n) {
  Random random(9);
  ModelBuilder builder;
  for (int i = 1; i <= n; ++i)
    builder.add_body("link" + std::to_string(i), i - 1, "joint" + std::to_string(i),
                     JointType::revolute, {random.rotation(), random.vector(0.3)}, random.vector(1),
                     random.inertia());
  return builder.build();
}

}  // namespace

TEST_CASE("a NaN torque is reported with its joint") {
  const Model<double> model = chain(5);
  for (int joint = 1; joint <= 5; ++joint) {
    ConstantTorque torque;
    torque.velocity = model.iv[static_cast<std::size_t>(joint)];
    torque.value = std::numeric_limits<double>::quiet_NaN();
    Simulation simulation(model, State<double>(model));
    simulation.add(torque);
    const StepReport report = simulation.step(1e-3);
    CHECK_FALSE(report.finite);
    CHECK(report.nonfinite_body == joint);
    CHECK(std::string(report.nonfinite_field) == "tau");
  }
}

TEST_CASE("a rejected source does not act") {
  const Model<double> model = chain(1);
  ConstantTorque torque;
  torque.implicit = true;
  torque.value = 1;
  Simulation simulation(model, State<double>(model));
  simulation.set_integrator(Integrator::rk4);
  CHECK_THROWS_AS(simulation.add(torque), std::invalid_argument);
  Simulation untouched(model, State<double>(model));
  untouched.set_integrator(Integrator::rk4);
  simulation.step(0.1);
  untouched.step(0.1);
  CHECK(simulation.state().qd[0] == untouched.state().qd[0]);
}

// Variables of the algorithms stay finite: no rotation, no gravity along the joint.
TEST_CASE("a coordinate that overflows is reported with its joint") {
  ModelBuilder builder;
  builder.add_body("block", 0, "slide", JointType::prismatic, {}, Vector3::UnitX(),
                   {1, Vector3::Zero(), Matrix3::Identity()});
  const Model<double> model = builder.build();
  State<double> x(model);
  x.q[0] = x.qd[0] = 1e308;
  Simulation simulation(model, x);
  const StepReport report = simulation.step(1);
  CHECK_FALSE(report.finite);
  CHECK(report.nonfinite_body == 1);
  CHECK(std::string(report.nonfinite_field ? report.nonfinite_field : "none") == "q");
}

TEST_CASE("a tolerance that is not positive and finite is rejected") {
  const Model<double> model = chain(1);
  Simulation simulation(model, State<double>(model));
  for (const double bad : {0.0, -1e-6, HUGE_VAL, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_WITH(simulation.set_integrator(Integrator::dopri5, bad),
                      "tolerance must be positive and finite");
  CHECK_NOTHROW(simulation.set_integrator(Integrator::dopri5, 1e-6));
}

TEST_CASE("a step size that is not positive and finite is rejected without any change") {
  const Model<double> model = chain(2);
  for (const Integrator integrator : {Integrator::semi_implicit, Integrator::dopri5})
    for (const bool limited : {false, true}) {
      if (limited && integrator == Integrator::dopri5) continue;
      CAPTURE(integrator_name(integrator));
      CAPTURE(limited);
      JointLimits limits(model);
      limits.add(1, -1e-4, 1e-4);
      Simulation simulation(model, State<double>(model));
      simulation.set_integrator(integrator);
      if (limited) simulation.add(limits);
      simulation.step(1e-3);
      const State<double> before = simulation.state();
      for (const double h :
           {0.0, -1e-3, HUGE_VAL, -HUGE_VAL, std::numeric_limits<double>::quiet_NaN()}) {
        CAPTURE(h);
        CHECK_THROWS_AS(simulation.step(h), InputError);
        CHECK_THROWS_AS(simulation.step(h, true), InputError);
        CHECK_THROWS_AS(side_step(simulation, h), InputError);
        CHECK(simulation.state().q == before.q);
        CHECK(simulation.state().qd == before.qd);
        CHECK(simulation.state().t == before.t);
      }
      CHECK_THROWS_WITH(simulation.step(-0.5),
                        "step size: is -0.5 s, must be positive and finite; give a step size in "
                        "seconds, such as 0.001");
      CHECK(simulation.step(1e-3).ok());
    }
}

namespace {

// No constraints, no events, not Checkpointable.
struct Plain final : ConstraintSource {
  void add_constraints(const ConstraintFrame&, ImpulseProblem&) noexcept override {}
  void read_impulses(const ConstraintFrame&, const ImpulseProblem&, std::size_t) noexcept override {
  }
};

}  // namespace

TEST_CASE("incompatible constraint sources are rejected") {
  const Model<double> model = chain(2);
  Plain plain;
  Simulation simulation(model, State<double>(model));
  simulation.set_integrator(Integrator::rk4);
  CHECK_THROWS_AS(simulation.add(plain), std::invalid_argument);
  simulation.set_integrator(Integrator::semi_implicit);
  Simulation located = simulation;
  simulation.add(plain);
  CHECK_THROWS_AS(simulation.set_integrator(Integrator::rk4), std::invalid_argument);
  CHECK_THROWS_AS(simulation.locate_events(), std::invalid_argument);
  CHECK_THROWS_AS(side_step(simulation, 1e-3), std::invalid_argument);
  StateArchive memory;
  CHECK_THROWS_AS(simulation.serialize(memory), std::invalid_argument);
  located.locate_events();
  CHECK_THROWS_AS(located.add(plain), std::invalid_argument);
}

TEST_CASE("event-driven steps require semi-implicit, in any order of calls") {
  const Model<double> model = chain(2);
  for (const IntegratorFacts& facts : all_integrators) {
    CAPTURE(std::string(facts.name));
    Simulation located_last(model, State<double>(model)), located_first = located_last;
    located_last.set_integrator(facts.integrator);
    located_first.locate_events();
    if (facts.integrator == Integrator::semi_implicit) {
      CHECK_NOTHROW(located_last.locate_events());
      CHECK_NOTHROW(located_first.set_integrator(facts.integrator));
    } else {
      CHECK_THROWS_AS(located_last.locate_events(), std::invalid_argument);
      CHECK_THROWS_AS(located_first.set_integrator(facts.integrator), std::invalid_argument);
      CHECK(located_first.integrator() == Integrator::semi_implicit);
    }
  }
}

TEST_CASE("a prescribed motion that opens a loop is rejected, the previous one is kept") {
  ModelBuilder builder;
  builder.add_body("hand", 0, "held", JointType::prescribed, {}, Vector3::UnitZ(),
                   {1, Vector3::Zero(), Matrix3::Identity()});
  builder.add_body("block", 0, "rail", JointType::prismatic, {}, Vector3::UnitZ(),
                   {1, Vector3::Zero(), Matrix3::Identity()});
  const Model<double> model = builder.build();
  const auto rising_from = [](double height) {
    return [height](double t) {
      PrescribedMotion motion;
      motion.X_JL.p = {0, 0, height + t};
      motion.velocity = Vector3::UnitZ();
      return motion;
    };
  };
  LoopClosure rod{"rod", LoopType::distance, 1, 2};
  rod.X_LaC.p = {0, 0, 0.3};
  rod.length = 0.3;
  Simulation simulation(model, State<double>(model));
  simulation.prescribe(1, rising_from(0));
  simulation.set_loops({rod});
  CHECK_THROWS_AS(simulation.prescribe(1, rising_from(0.5)), InputError);
  for (int n = 0; n < 10; ++n) CHECK(simulation.step(1e-2).ok());
  CHECK((simulation.kinematics().X_WL[1].p - Vector3(0, 0, 0.1)).norm() < 1e-12);
}

namespace {

// A force that grows with every begin_step(); Checkpointable.
struct Counting final : ForceSource, Checkpointable {
  double begun = 0;
  void begin_step(const Kinematics&, double, double) noexcept override { ++begun; }
  void add_forces(const State<double>&, const Kinematics&, Forces<double>& f) noexcept override {
    f.tau[0] += begun;
  }
  void serialize(StateArchive& memory) override { memory.visit(begun); }
};

}  // namespace

TEST_CASE("evaluate_at() evaluates forces at another state in a copy") {
  const Model<double> model = chain(3);
  Random random(63);
  const State<double> start = random_state(random, model), elsewhere = random_state(random, model);
  Counting source;
  Simulation simulation(model, start);
  simulation.add(source);
  Workspace<double> w(model);
  Forces<double> pushed(model);
  pushed.tau[0] = 1;
  aba(model, elsewhere, pushed, w);
  std::optional<IntegrationState> there;
  for (int call = 0; call < 2; ++call) {
    evaluate_at(simulation, elsewhere, there);
    CHECK(there->x.q == elsewhere.q);
    CHECK(there->x.qd == elsewhere.qd);
    CHECK(there->w.qdd == w.qdd);
    evaluate_at(simulation, start, there);
    CHECK(there->w.qdd != w.qdd);
  }
  CHECK(source.begun == 0);
  CHECK(simulation.state().q == start.q);
  CHECK(simulation.state().qd == start.qd);
}
