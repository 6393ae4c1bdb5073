// The equations of the passes, term by term, on mechanisms of all joints.
#include <doctest/doctest.h>

#include <map>

#include "app/inspect/displayed_quantities.h"
#include "app/inspect/equations.h"
#include "tests/solver/dynamics/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

std::vector<Actor> pushed(Random& random, const Model<double>& model, bool implicit) {
  Forces<double> forces(model);
  const auto vec = [&] {
    return Vec3<double>{random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5)};
  };
  for (std::size_t dof = 0; dof < model.nv; ++dof) {
    forces.tau[dof] = random.uniform(-5, 5);
    if (implicit) forces.armature[dof] = random.uniform(0, 0.5);
  }
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    forces.f_ext[i] = {vec(), vec()};
    if (implicit) forces.impedance[i].M = Sym3<double>::scaled_identity(random.uniform(0, 1));
  }
  return {actor_of("all", forces)};
}

}  // namespace

TEST_CASE("the terms of every equation add up to what aba() has, on random trees of all joints") {
  Random random(31);
  const std::vector<JointType> types{all_joint_types.begin(), all_joint_types.end()};
  std::map<std::string, int> met;
  for (int k = 0; k < 300; ++k) {
    CAPTURE(k);
    std::vector<TreeBody> bodies = random_bodies(random, random.integer(1, 9), types);
    for (TreeBody& body : bodies)
      if (random.integer(0, 2) == 0) body.properties.armature = random.uniform(0, 1);
    const Model<double> model = build(bodies);
    const State<double> x = random_state(random, model);
    const Inspection in(model, x, pushed(random, model, k % 2 == 1));
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

TEST_CASE("a body's left sides are the numbers that the passes show of it") {
  Random random(32);
  const std::vector<JointType> types{all_joint_types.begin(), all_joint_types.end()};
  for (int k = 0; k < 50; ++k) {
    const Model<double> model = build(random_bodies(random, 6, types));
    const Inspection in(model, random_state(random, model), pushed(random, model, true));
    for (std::size_t i = 1; i < in.body_count(); ++i)
      for (const int pass : {1, 2, 3}) {
        const std::vector<Shown> shown = shown_quantities(in, pass, i);
        for (const Equation& equation : equations_of(in, pass, i))
          for (const Shown& quantity : shown)
            if (equation.name == quantity.quantity.name) CHECK(equation.value == quantity.value);
      }
  }
}
