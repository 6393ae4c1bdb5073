// Steps: no allocation, non-finite numbers reported, implicit sources rejected by Runge-Kutta.
// Conservation: benchmarks/analytic/joints/floating_tree.cpp, A5.
#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "solver/dynamics/model_builder.h"
#include "solver/stepping/simulation.h"
#include "tests/solver/dynamics/random_tree.h"
#include "tests/support/count_allocations.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

Model<double> mixed_tree(Random& random, int n, bool floating) {
  ModelBuilder builder;
  for (int i = 1; i <= n; ++i) {
    const JointType type = i == 1 && floating ? JointType::free
                           : i % 4 == 3       ? JointType::prismatic
                                              : JointType::revolute;
    builder.add_body("body" + std::to_string(i), floating ? random.integer(i > 1, i - 1) : i - 1,
                     "joint" + std::to_string(i), type, {random.rotation(), random.vector(0.3)},
                     random.vector(1), random.inertia());
  }
  return builder.build();
}

// At a joint.
struct Torque final : ForceSource {
  std::size_t joint = 0;
  double value = 0;
  void add_forces(const State<double>& x, const Kinematics&,
                  Forces<double>& forces) noexcept override {
    forces.tau[joint] += value * std::cos(x.t);
  }
};
std::vector<double>& kept() {
  static std::vector<double> numbers;
  return numbers;
}

struct ImplicitArmature final : ForceSource {
  void add_forces(const State<double>&, const Kinematics&,
                  Forces<double>& forces) noexcept override {
    forces.armature[0] += 1;
  }
  bool needs_semi_implicit() const override { return true; }
};

}  // namespace

TEST_CASE("a step and its report allocate nothing, under every integrator") {
  Random random(8);
  const Model<double> model = mixed_tree(random, 8, true);
  CHECK(allocations_in([] { std::vector<double>(3).swap(kept()); }) == 1);  // the counter works
  for (const IntegratorFacts& facts : all_integrators) {
    const Integrator integrator = facts.integrator;
    CAPTURE(std::string(facts.name));
    Torque torque;
    Simulation simulation(model, random_state(random, model));
    simulation.add(torque);
    simulation.set_integrator(integrator);
    CHECK(allocations_in([&] {
            for (int n = 0; n < 5; ++n) simulation.step(1e-3);
            torque.value = std::numeric_limits<double>::quiet_NaN();
            simulation.step(1e-3);
          }) == 0);
  }
}

TEST_CASE("a step with joint friction, its events and mimic joints allocates nothing") {
  Random random(11);
  ModelBuilder builder;
  for (int i = 1; i <= 6; ++i) {
    JointProperties p;
    p.damping = 0.1;
    p.coulomb_plus = p.coulomb_minus = 0.3 * i;
    builder.add_body("body" + std::to_string(i), i - 1, "joint" + std::to_string(i),
                     JointType::revolute, {random.rotation(), random.vector(0.3)}, random.vector(1),
                     random.inertia(), p);
  }
  builder.add_mimic("joint4", "joint2", -0.5, 0.1);
  const Model<double> model = builder.build();
  for (const IntegratorFacts& facts : all_integrators) {
    CAPTURE(std::string(facts.name));
    Simulation simulation(model, random_state(random, model));
    simulation.set_integrator(facts.integrator);
    int events = 0;
    CHECK(allocations_in([&] {
            for (int n = 0; n < 50; ++n) events += simulation.step(0.01).events;
          }) == 0);
    if (!facts.implicit_force) CHECK(events > 0);
    // A side step is bit-identical to the following step and has no effect.
    const State<double> aside = side_step(simulation, 0.01);
    simulation.step(0.01);
    CHECK(aside.q == simulation.state().q);
    CHECK(aside.qd == simulation.state().qd);
  }
}

TEST_CASE("a NaN torque is reported in its step and in all later ones") {
  Random random(9);
  const Model<double> model = mixed_tree(random, 5, false);
  for (const IntegratorFacts& facts : all_integrators)
    for (double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      const Integrator integrator = facts.integrator;
      CAPTURE(std::string(facts.name));
      Torque torque;
      torque.joint = model.iv[3];
      Simulation simulation(model, State<double>(model));
      simulation.add(torque);
      simulation.set_integrator(integrator);
      const StepReport good = simulation.step(1e-3);
      CHECK(good.finite);
      CHECK(good.nonfinite_body == 0);
      CHECK(good.nonfinite_field == nullptr);
      torque.value = bad;
      for (int n = 0; n < 3; ++n) {
        const StepReport report = simulation.step(1e-3);
        CHECK_FALSE(report.finite);
        CHECK(report.nonfinite_body > 0);
        CHECK(report.nonfinite_field != nullptr);
        torque.value = 0;  // the state stays non-finite
      }
    }
}

TEST_CASE("implicit sources require semi-implicit integrators, in any order of calls") {
  Random random(10);
  const Model<double> model = mixed_tree(random, 2, false);
  for (const IntegratorFacts& facts : all_integrators) {
    CAPTURE(std::string(facts.name));
    ImplicitArmature source;
    Simulation source_last(model, State<double>(model));
    source_last.set_integrator(facts.integrator);
    Simulation source_first(model, State<double>(model));
    source_first.add(source);
    if (std::string(facts.name).starts_with("semi-implicit")) {
      CHECK_NOTHROW(source_last.add(source));
      CHECK_NOTHROW(source_first.set_integrator(facts.integrator));
    } else {
      CHECK_THROWS_AS(source_last.add(source), std::invalid_argument);
      CHECK_THROWS_AS(source_first.set_integrator(facts.integrator), std::invalid_argument);
      CHECK_NOTHROW(source_first.set_integrator(Integrator::semi_implicit));
    }
  }
}
