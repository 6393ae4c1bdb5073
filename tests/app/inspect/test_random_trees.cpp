// Cross-checks and equations of the passes, on random mechanisms of all joints.
#include <doctest/doctest.h>

#include <map>

#include "app/inspect/cross_checks.h"
#include "app/inspect/force_balance.h"
#include "app/inspect/inspection.h"
#include "tests/solver/dynamics/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

const std::vector<JointType> kAllTypes{all_joint_types.begin(), all_joint_types.end()};

Model<double> tree_with_armatures(Random& random) {
  std::vector<TreeBody> bodies = random_bodies(random, random.integer(1, 9), kAllTypes);
  for (TreeBody& body : bodies)
    if (random.integer(0, 2) == 0) body.properties.armature = random.uniform(0, 1);
  return build(bodies);
}

// Torques, wrenches, and added inertia of implicit spring-dampers.
std::vector<AppliedForce> random_actors(Random& random, const Model<double>& model, bool implicit) {
  Forces<double> forces(model);
  const auto vec = [&](double size) {
    return Vec3<double>{random.uniform(-size, size), random.uniform(-size, size),
                        random.uniform(-size, size)};
  };
  for (std::size_t dof = 0; dof < model.nv; ++dof) {
    forces.tau[dof] = random.uniform(-5, 5);
    if (implicit) forces.armature[dof] = random.uniform(0, 0.5);
  }
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    forces.f_ext[i] = {vec(5), vec(5)};
    if (implicit) {
      const double m = random.uniform(0, 1);
      forces.added_inertia[i].M = Sym3<double>::scaled_identity(m);
      forces.added_inertia[i].I = Sym3<double>::scaled_identity(random.uniform(0, 0.3));
    }
  }
  return {actor_of("all", forces)};
}

// Sum of the wrenches on a body, relative to their largest number.
double rest_of_wrenches(const BodyBalance& balance) {
  Vector6 sum = Vector6::Zero();
  double largest = 0;
  for (const NamedWrench& wrench : balance.wrenches) {
    const Vector6 six = (Vector6() << wrench.force, wrench.torque).finished();
    sum += six;
    largest = std::max(largest, six.lpNorm<Eigen::Infinity>());
  }
  return largest > 0 ? sum.lpNorm<Eigen::Infinity>() / largest : 0;
}

}  // namespace

TEST_CASE("all cross-checks pass on 1,000 random trees and states of all joints") {
  Random random(20);
  std::map<std::string, double> worst;
  for (int k = 0; k < 1000; ++k) {
    CAPTURE(k);
    const Model<double> model = tree_with_armatures(random);
    const State<double> x = random_state(random, model);
    const Inspection in(model, x, random_actors(random, model, k % 2 == 1));
    for (const Check& check : run_checks(in)) {
      CAPTURE(check.name);
      CHECK_MESSAGE(check.pass(), check.name, " ", check.error);
      double& largest = worst[check.name];
      largest = std::max(largest, check.error);
    }
    double& rest = worst["wrenches on a body, of the largest"];
    for (std::size_t i = 1; i < in.body_count(); ++i)
      rest = std::max(rest, rest_of_wrenches(balance_of(in, i)));
    CHECK(rest < 1e-10);
  }
  for (const auto& [name, error] : worst) MESSAGE(name, ": ", error);
}

TEST_CASE("cross-checks: an error of 1e-8 is detected by the check of that quantity") {
  Random random(21);
  const Model<double> model = random_tree(random, 4, {JointType::revolute});
  const State<double> x = random_state(random, model);
  const Inspection good(model, x, random_actors(random, model, false));
  const auto fails = [&](const char* name, auto spoil) {
    CAPTURE(name);
    Inspection bad = good;
    spoil(bad.w);
    bool found = false;
    for (const Check& check : run_checks(bad))
      if (check.name == name) {
        CHECK_FALSE(check.pass());
        CHECK(check.worst.size() > 0);
        found = true;
      }
    CHECK(found);
  };
  constexpr double kOff = 1 + 1e-8;
  using W = Workspace<double>;
  fails("v", [&](W& w) { w.v[2].w = kOff * w.v[2].w; });
  fails("D", [&](W& w) { w.D[1] *= kOff; });
  fails("U", [&](W& w) { w.U[1] = kOff * w.U[1]; });
  fails("pA", [&](W& w) { w.pA[2] = kOff * w.pA[2]; });
  fails("u", [&](W& w) { w.u[1] += 1e-6; });
  fails("qdd", [&](W& w) { w.qdd[1] += 1e-6; });
  fails("a", [&](W& w) { w.a[2].v.x += 1e-6; });
  fails("tau", [&](W& w) { w.qdd[1] += 1e-6; });
  fails("f", [&](W& w) { w.IA[2].I.xx += 1e-6; });
  fails("balance", [&](W& w) { w.pA[2].f.x += 1e-6; });
  fails("momentum", [&](W& w) { w.qdd[1] += 1e-5; });
}

TEST_CASE("the terms of every equation sum to the result of aba(), on random trees of all joints") {
  Random random(31);
  std::map<std::string, int> met;
  for (int k = 0; k < 300; ++k) {
    CAPTURE(k);
    const Model<double> model = tree_with_armatures(random);
    const State<double> x = random_state(random, model);
    const Inspection in(model, x, random_actors(random, model, k % 2 == 1));
    for (std::size_t i = 1; i < in.body_count(); ++i)
      for (const int pass : {1, 2, 3})
        for (const Equation& equation : equations_of(in, pass, i)) {
          CAPTURE(equation.text);
          CHECK(equation.residual <= 1e-10);
          ++met[equation.name];
        }
  }
  for (const char* name :
       {"v", "c", "p", "IA", "pA", "U", "D", "u", "Ia", "pa", "a'", "D qdd", "a"})
    CHECK_MESSAGE(met[name] > 100, name);
}

TEST_CASE("left sides of the equations are the displayed quantities") {
  Random random(32);
  for (int k = 0; k < 50; ++k) {
    const Model<double> model = build(random_bodies(random, 6, kAllTypes));
    const Inspection in(model, random_state(random, model), random_actors(random, model, true));
    for (std::size_t i = 1; i < in.body_count(); ++i)
      for (const int pass : {1, 2, 3}) {
        const std::vector<DisplayedQuantity> shown = shown_quantities(in, pass, i);
        for (const Equation& equation : equations_of(in, pass, i))
          for (const DisplayedQuantity& quantity : shown)
            if (equation.name == quantity.quantity.name) CHECK(equation.value == quantity.value);
      }
  }
}
