// No pass takes anything from the heap, in any scalar and at any level; nor do what looks at its
// results.
#include "solver/dynamics/operational_space.h"
#include "solver/dynamics/world_kinematics.h"
#include "tests/solver/count_allocations.h"
#include "tests/solver/every_scalar.h"

using namespace twinarm;
using namespace twinarm::testing;

TEST_CASE_TEMPLATE("passes take nothing from the heap, for every joint", S, TWINARM_SCALARS) {
  Random random(1);
  for (const auto& types : lists_of_types()) {
    Packed<S> p(random, random_tree(random, 8, types));
    for (std::size_t i = 1; i < p.model.parent.size(); ++i)
      p.forces[0].add_impedance(i, ArticulatedInertia<double>(p.model.I[i]));
    p.pack();
    Workspace<S> w(p.model_S);
    const std::vector<S> zero(p.model.nv);
    std::vector<Force<S>> wrench(p.model.parent.size());
    std::vector<Motion<S>> J(p.model.nv);
    const std::size_t tip = p.model.parent.size() - 1;
    for (const Isa isa : levels_of<S>()) {
      const Passes<S>& pass = passes<S>(isa);
      CHECK(allocations_in([&] { pass.aba(p.model_S, p.x_S, p.forces_S, w); }) == 0);
      CHECK(allocations_in([&] { pass.rnea(p.model_S, p.x_S, w.qdd, p.forces_S.f_ext, w); }) == 0);
      CHECK(allocations_in([&] { pass.crba(p.model_S, p.x_S, w); }) == 0);
      CHECK(allocations_in([&] { pass.minv_times(p.model_S, zero, wrench, w); }) == 0);
      CHECK(allocations_in([&] { pass.kinematics(p.model_S, p.x_S, w); }) == 0);
    }
    CHECK(allocations_in([&] {
            aba(p.model_S, p.x_S, p.forces_S, w);
            const Vec3<S> r{S(1), S(2), S(3)};
            jacobian(p.model_S, w, tip, r, J);
            jacobian_rate_times_qd(p.model_S, w, tip, r);
            point_acceleration(p.model_S, w, tip, r);
            mass_and_com(p.model_S, w);
            momentum(p.model_S, w);
            kinetic_energy(p.model_S, p.x_S, w);
            potential_energy(p.model_S, w);
            inverse_operational_inertia(p.model_S, tip, r, zero, wrench, w);
            p.forces_S.clear();
          }) == 0);
  }
}

TEST_CASE("the traced ABA takes nothing from the heap, and gives the bits of the generic level") {
  Random random(2);
  const Model<double> model =
      random_tree(random, 12, {all_joint_types.begin(), all_joint_types.end()});
  const State<double> x = random_state(random, model);
  const Forces<double> forces = random_forces(random, model);
  Workspace<double> w(model), plain(model);
  FullTrace<double> trace(model.parent.size());
  CHECK(allocations_in([&] { aba(model, x, forces, w, trace); }) == 0);
  passes<double>(Isa::generic).aba(model, x, forces, plain);
  CHECK(w.qdd == plain.qdd);
}
