// Loop closures in constrained steps: reported errors, and replacement of loops.
#include <doctest/doctest.h>

#include <cmath>
#include <locale>
#include <stdexcept>
#include <string>

#include "solver/constraints/joint_limits.h"
#include "solver/dynamics/model_builder.h"
#include "solver/stepping/simulation.h"
#include "solver/support/diagnostics.h"
#include "solver/support/state_archive.h"

using namespace twinarm;

namespace {

// Two equal pendulums about y, 0.5 m apart, and limits far away: all steps are constrained.
struct Pendulums {
  explicit Pendulums(std::vector<LoopClosure> loops)
      : model([] {
          ModelBuilder builder;
          const BodyInertia inertia{1, {0, 0, -0.5}, 0.1 * Matrix3::Identity()};
          builder.add_body("a", 0, "ja", JointType::revolute, {}, Vector3::UnitY(), inertia);
          builder.add_body("b", 0, "jb", JointType::revolute, {Matrix3::Identity(), {0.5, 0, 0}},
                           Vector3::UnitY(), inertia);
          return builder.build();
        }()),
        limits(model),
        simulation(model, State<double>(model)) {
    limits.add(1, -3, 3);
    limits.add(2, -1e-4, 1e-4);
    simulation.set_loops(std::move(loops));
    simulation.add(limits);
  }
  Pendulums(const Pendulums&) = delete;
  std::string memory() {
    StateArchive memory;
    simulation.serialize(memory);
    return memory.bytes();
  }

  Model<double> model;
  JointLimits limits;
  Simulation simulation;
};

// A rod of 0.5 m between their tips.
LoopClosure ball() {
  LoopClosure loop{"tips", LoopType::ball, 1, 2};
  loop.X_LaC.p = {0.5, 0, -1}, loop.X_LbC.p = {0, 0, -1};
  return loop;
}
LoopClosure rod() {
  LoopClosure loop{"rod", LoopType::distance, 1, 2};
  loop.X_LaC.p = loop.X_LbC.p = {0, 0, -1};
  loop.length = 0.5;
  return loop;
}

}  // namespace

TEST_CASE("loops: after removal, constrained steps are those without loops") {
  Pendulums opened({ball()}), free({});
  State<double> x(opened.model);
  x.qd[0] = x.qd[1] = 0.05;
  opened.simulation.set_state(x);
  CHECK(opened.simulation.step(1e-3).ok());
  opened.simulation.set_loops({});
  free.simulation.set_state(opened.simulation.state());
  for (int n = 0; n < 10; ++n) {
    CHECK(opened.simulation.step(1e-3).ok());
    CHECK(free.simulation.step(1e-3).ok());
    CHECK(opened.memory().size() == free.memory().size());
    for (std::size_t dof = 0; dof < 2; ++dof)
      CHECK(std::abs(opened.simulation.state().qd[dof] - free.simulation.state().qd[dof]) < 1e-12);
  }
}

TEST_CASE("loops: state data of a simulation with other loops is rejected") {
  Pendulums one({ball()}), other({rod()});
  for (Pendulums* each : {&one, &other}) CHECK(each->simulation.step(1e-3).ok());
  StateArchive memory(one.memory()), own(other.memory());
  CHECK_THROWS_AS(other.simulation.serialize(memory), std::runtime_error);
  CHECK_NOTHROW(other.simulation.serialize(own));
  CHECK(own.at_end());
}

TEST_CASE("loops: the error of an open loop does not depend on the program's locale") {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
  };
  ModelBuilder builder;
  const BodyInertia inertia{1, Vector3::Zero(), Matrix3::Identity()};
  builder.add_body("block", 0, "rail", JointType::prismatic, {}, Vector3::UnitZ(), inertia);
  const Model<double> model = builder.build();
  State<double> x(model);
  x.q[0] = 0.25;
  Simulation simulation(model, x);
  const std::locale before = std::locale::global({std::locale::classic(), new Comma});
  std::string text;
  try {
    simulation.set_loops({LoopClosure{"tie", LoopType::ball, 0, 1}});
  } catch (const InputError& error) {
    text = error.what();
  }
  std::locale::global(before);
  CAPTURE(text);
  CHECK(text.find("0.25 ") != std::string::npos);
}

// A prescribed joint moves away, with zero given velocity, from a block on a rail: only the
// position error shows that the loop opens.
TEST_CASE("loops: a constrained step reports the position error") {
  for (const bool located : {false, true}) {
    CAPTURE(located);
    ModelBuilder builder;
    const BodyInertia inertia{1, Vector3::Zero(), Matrix3::Identity()};
    builder.add_body("hand", 0, "held", JointType::prescribed, {}, Vector3::UnitZ(), inertia);
    builder.add_body("block", 0, "rail", JointType::prismatic, {}, Vector3::UnitZ(), inertia);
    const Model<double> model = builder.build();
    LoopClosure tie{"tie", LoopType::ball, 1, 2};
    JointLimits limits(model);
    limits.add(2, -100, 100);
    Simulation simulation(model, State<double>(model));
    simulation.prescribe(1, [](double t) {
      PrescribedMotion motion;
      motion.X_JL.p.x() = t * t;
      return motion;
    });
    simulation.set_loops({tie});
    simulation.add(limits);
    if (located) simulation.locate_events();
    for (int n = 1; n <= 3; ++n) {
      const StepReport report = simulation.step(1e-3);
      const double t = simulation.state().t;
      CHECK(report.loop_position_error == doctest::Approx(t * t).epsilon(1e-12));
      CHECK(report.converged);
      CHECK_FALSE(report.ok());
    }
  }
}
