// A workspace used before gives the bits of a fresh one, though factors are kept.
#include "solver/dynamics/dynamics.h"
#include "tests/solver/dynamics/every_scalar.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

// Joint of six coordinates, on the world and in a tree.
std::vector<JointType> mostly_free() {
  return {JointType::free, JointType::free, JointType::revolute};
}

}  // namespace

TEST_CASE("aba of a used workspace: any state, implicit damping and pass before it") {
  Random random(21);
  for (int n = 0; n < 20; ++n) {
    const Model<double> model = random_tree(random, 8, mostly_free());
    for (const Isa isa : levels_of<double>()) {
      const Passes<double>& pass = passes<double>(isa);
      Workspace<double> used(model);
      MatrixWorkspace<double> matrices(model);
      std::vector<double> Minv(model.nv * model.nv);
      Forces<double> forces = random_forces(random, model);
      State<double> x = random_state(random, model);
      for (int call = 0; call < 30; ++call) {
        if (random.integer(0, 3) == 0) x = random_state(random, model);
        const int change = random.integer(0, 3);
        for (double& damping : forces.armature)
          if (change < 2) damping = change == 0 ? 0 : random.uniform(0, 0.1);
        if (change == 2) pass.minv_matrix(model, x, used, matrices, Minv);
        Workspace<double> fresh(model);
        pass.aba(model, x, forces, fresh);
        pass.aba(model, x, forces, used);
        REQUIRE(used.qdd == fresh.qdd);
      }
    }
  }
}
