// What a step promises whatever the mechanism: no allocation, no silent NaN, no implicit source in
// a Runge-Kutta step. Conservation is benchmarks/analytic/joints/floating_tree.cpp, A5.
#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "solver/dynamics/energy_momentum.h"
#include "solver/dynamics/model_builder.h"
#include "solver/stepping/simulation.h"
#include "tests/solver/dynamics/random_tree.h"
#include "tests/support/count_allocations.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

// A tree of n bodies whose inertias are kept, so that energies can be summed without the passes.
struct Tree {
  Model<double> model;
  std::vector<BodyInertia> inertia{{}};
  Tree(Random& random, int n, bool floating, const Vector3& gravity) {
    ModelBuilder builder;
    builder.set_gravity(gravity);
    for (int i = 1; i <= n; ++i) {
      inertia.push_back(random.inertia());
      const JointType type = i == 1 && floating ? JointType::free
                             : i % 4 == 3       ? JointType::prismatic
                                                : JointType::revolute;
      builder.add_body("body" + std::to_string(i), floating ? random.integer(i > 1, i - 1) : i - 1,
                       "joint" + std::to_string(i), type, {random.rotation(), random.vector(0.3)},
                       random.vector(1), inertia.back());
    }
    model = builder.build();
  }
  // Kinetic and potential.
  std::pair<double, double> energies(const State<double>& x) const {
    Kinematics k(model);
    forward_kinematics(model, x, k);
    std::pair sum{0.0, 0.0};
    for (int i = 1; i < model.body_count(); ++i) {
      const auto b = static_cast<std::size_t>(i);
      const Vector3 com = k.position(i, inertia[b].com), v = k.velocity(i, com), w = k.w_WL[b];
      const Matrix3 I = k.X_WL[b].R * inertia[b].inertia * k.X_WL[b].R.transpose();
      sum.first += 0.5 * inertia[b].mass * v.squaredNorm() + 0.5 * w.dot(I * w);
      sum.second -= inertia[b].mass * to_eigen(model.gravity).dot(com);
    }
    return sum;
  }
};

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

TEST_CASE(
    "energy_momentum.h gives the kinetic and potential energy that a sum over the links gives") {
  Random random(3);
  for (int n = 1; n <= 12; ++n) {
    const Tree tree(random, n, n % 2 == 0, {0.2, -0.4, -9.81});
    const State<double> x = random_state(random, tree.model);
    const auto [kinetic, potential] = tree.energies(x);
    CHECK(kinetic_energy(tree.model, x) == doctest::Approx(kinetic).epsilon(1e-12));
    CHECK(potential_energy(tree.model, x) == doctest::Approx(potential).epsilon(1e-12));
  }
}

TEST_CASE("a step takes nothing from the heap, under every integrator, nor does its report") {
  Random random(8);
  const Tree tree(random, 8, true, {0, 0, -9.81});
  CHECK(allocations_in([] { std::vector<double>(3).swap(kept()); }) == 1);  // the count counts
  for (const IntegratorFacts& facts : all_integrators) {
    const Integrator integrator = facts.integrator;
    CAPTURE(std::string(facts.name));
    Torque torque;
    Simulation simulation(tree.model, random_state(random, tree.model));
    simulation.add(torque);
    simulation.set_integrator(integrator);
    CHECK(allocations_in([&] {
            for (int n = 0; n < 5; ++n) simulation.step(1e-3);
            torque.value = std::numeric_limits<double>::quiet_NaN();
            simulation.step(1e-3);
          }) == 0);
  }
}

TEST_CASE("nor does a step with joint friction, its events, and joints that follow others") {
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
    // A side step gives the bits of the step that follows, and disturbs nothing.
    const State<double> aside = simulation.side_step(0.01);
    simulation.step(0.01);
    CHECK(aside.q == simulation.state().q);
    CHECK(aside.qd == simulation.state().qd);
  }
}

TEST_CASE("a torque that is not a number is reported in its step and in all later ones") {
  Random random(9);
  const Tree tree(random, 5, false, {0, 0, -9.81});
  for (const IntegratorFacts& facts : all_integrators)
    for (double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      const Integrator integrator = facts.integrator;
      CAPTURE(std::string(facts.name));
      Torque torque;
      torque.joint = tree.model.iv[3];
      Simulation simulation(tree.model, State<double>(tree.model));
      simulation.add(torque);
      simulation.set_integrator(integrator);
      const StepReport good = simulation.step(1e-3);
      CHECK(good.finite);
      CHECK(good.bad_body == 0);
      CHECK(good.bad_field == nullptr);
      torque.value = bad;
      for (int n = 0; n < 3; ++n) {
        const StepReport report = simulation.step(1e-3);
        CHECK_FALSE(report.finite);
        CHECK(report.bad_body > 0);
        CHECK(report.bad_field != nullptr);
        torque.value = 0;  // what went wrong stays wrong: nothing is reset
      }
    }
}

TEST_CASE("a source that is implicit goes with the semi-implicit methods, whichever comes first") {
  Random random(10);
  const Tree tree(random, 2, false, {0, 0, -9.81});
  for (const IntegratorFacts& facts : all_integrators) {
    CAPTURE(std::string(facts.name));
    ImplicitArmature source;
    Simulation source_last(tree.model, State<double>(tree.model));
    source_last.set_integrator(facts.integrator);
    Simulation source_first(tree.model, State<double>(tree.model));
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
