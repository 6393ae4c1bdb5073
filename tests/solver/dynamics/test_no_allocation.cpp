// The algorithms and the functions of their results allocate nothing, for all scalars and levels.
#include "solver/dynamics/derivatives.h"
#include "solver/dynamics/energy_momentum.h"
#include "solver/dynamics/world_kinematics.h"
#include "tests/solver/dynamics/every_scalar.h"
#include "tests/support/count_allocations.h"

using namespace twinarm;
using namespace twinarm::testing;

TEST_CASE_TEMPLATE("the algorithms allocate nothing, for every joint", S, TWINARM_SCALARS) {
  Random random(1);
  for (const auto& types : lists_of_types()) {
    Packed<S> p(random, random_tree(random, 8, types));
    for (std::size_t i = 1; i < p.model.parent.size(); ++i)
      p.forces[0].add_inertia(i, ArticulatedInertia<double>(p.model.I[i]));
    p.pack();
    Workspace<S> w(p.model_S);
    const std::vector<S> zero(p.model.nv);
    std::vector<Force<S>> wrench(p.model.parent.size());
    std::vector<Motion<S>> J(p.model.nv);
    std::vector<S> M(p.model.nv * p.model.nv);
    const std::size_t tip = p.model.parent.size() - 1;
    for (const Isa isa : levels_of<S>()) {
      const Passes<S>& pass = passes<S>(isa);
      CHECK(allocations_in([&] { pass.aba(p.model_S, p.x_S, p.forces_S, w); }) == 0);
      CHECK(allocations_in([&] { pass.rnea(p.model_S, p.x_S, w.qdd, p.forces_S.f_ext, w); }) == 0);
      CHECK(allocations_in([&] { pass.crba_in_body_axes(p.model_S, p.x_S, w, M); }) == 0);
      CHECK(allocations_in([&] { pass.crba_in_common_axes(p.model_S, p.x_S, w, M); }) == 0);
      CHECK(allocations_in([&] { pass.minv_times(p.model_S, zero, wrench, w); }) == 0);
      CHECK(allocations_in([&] { pass.kinematics(p.model_S, p.x_S, w); }) == 0);
    }
    CHECK(allocations_in([&] {
            aba(p.model_S, p.x_S, p.forces_S, w);
            const Vec3<S> r{S(1), S(2), S(3)};
            jacobian(p.model_S, w, tip, r, J);
            point_acceleration(p.model_S, w, tip, r);
            mass_and_com(p.model_S, w);
            momentum(p.model_S, w);
            kinetic_energy(p.model_S, p.x_S, w);
            potential_energy(p.model_S, w);
            p.forces_S.clear();
          }) == 0);
  }
}

TEST_CASE("derivatives and the inverse mass matrix allocate nothing, for every joint") {
  Random random(3);
  for (const auto& types : lists_of_types()) {
    const Packed<double> p(random, random_tree(random, 8, types));
    Workspace<double> w(p.model);
    MatrixWorkspace<double> m(p.model);
    AbaDerivatives<double> all(p.model);
    CHECK(allocations_in([&] { minv_matrix(p.model, p.x[0], w, m, all.Minv); }) == 0);
    aba(p.model, p.x[0], p.forces[0], w);
    CHECK(allocations_in([&] { aba_derivatives(p.model, p.x[0], p.forces[0], w, m, all); }) == 0);
  }
}

TEST_CASE("traced ABA allocates nothing and is bit-identical to the generic level") {
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

TEST_CASE("workspace, kinematics and energy of n free bodies take O(n) memory") {
  const auto bytes_of = [](int n) {
    ModelBuilder builder;
    for (int i = 0; i < n; ++i)
      builder.add_body("body" + std::to_string(i), 0, "joint" + std::to_string(i), JointType::free,
                       {}, Vector3::UnitZ(), {1, Vector3::Zero(), Matrix3::Identity()});
    long bytes = 0;
    bytes += bytes_in([&] { builder.build(); });
    const Model<double> model = builder.build();
    const State<double> x(model);
    return bytes + bytes_in([&] {
             const Workspace<double> w(model);
             Kinematics k(model);
             forward_kinematics(model, x, k);
             kinetic_energy(model, x);
             potential_energy(model, x);
           });
  };
  const long few = bytes_of(100), many = bytes_of(1000);
  MESSAGE("100 bodies " << few << " bytes, 1000 bodies " << many);
  CHECK(many < 12 * few);
}
