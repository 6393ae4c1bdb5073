// Derivatives of forward dynamics by dual numbers against finite differences.
#include "solver/dynamics/derivatives.h"
#include "solver/dynamics/dynamics.h"

#include "tests/solver/dynamics/every_scalar.h"
#include "tests/solver/dynamics/world_oracle.h"

using namespace twinarm;
using namespace twinarm::testing;
using Eigen::VectorXd;

namespace {

// Of qdd, by central differences of eighth order, along a motion s -> state.
template <class Move>
VectorXd slope(const Model<double>& model, const State<double>& x, const Forces<double>& forces,
               Move&& move) {
  VectorXd d1, d2;
  Workspace<double> w(model);
  differentiate(
      [&](Real s) -> VectorXd {
        State<double> y = x;
        move(static_cast<double>(s) / 4, y);  // steps of 1e-3
        aba(model, y, forces, w);
        return lane_of(w.qdd, 0);
      },
      d1, d2);
  return 4 * d1;
}

}  // namespace

TEST_CASE("derivatives of qdd by q and qd agree with finite differences, for every joint") {
  Random random(1);
  double by_q = 0, by_qd = 0;
  for (const auto& types : lists_of_types())
    for (int n = 0; n < 8; ++n) {
      const Model<double> model = random_tree(random, random.integer(1, 6), types);
      const State<double> x = random_state(random, model);
      Forces<double> forces = random_forces(random, model);
      for (double& armature : forces.armature) armature = random.uniform(0, 1);
      if (n % 2)
        for (std::size_t i = 1; i < model.parent.size(); ++i)
          forces.add_inertia(i, ArticulatedInertia<double>(model.I[i]));
      const ForwardDynamicsDerivatives d = forward_dynamics_derivatives(model, x, forces);
      REQUIRE(d.dq.rows() == static_cast<Eigen::Index>(model.nv));
      for (std::size_t k = 0; k < model.nv; ++k) {
        const auto column = static_cast<Eigen::Index>(k);
        const VectorXd q = slope(model, x, forces, [&](double s, State<double>& y) {
          std::vector<double> shift(model.nv);
          shift[k] = s;
          for (std::size_t i = 1; i < model.parent.size(); ++i)
            visit_joint(model, i, [&](auto joint) {
              joint.integrate(&x.q[model.iq[i]], shift.data() + model.iv[i], &y.q[model.iq[i]]);
            });
        });
        const VectorXd qd =
            slope(model, x, forces, [&](double s, State<double>& y) { y.qd[k] += s; });
        by_q = std::max(by_q, (d.dq.col(column) - q).norm() / (1 + d.dq.norm()));
        by_qd = std::max(by_qd, (d.dqd.col(column) - qd).norm() / (1 + d.dqd.norm()));
      }
    }
  MESSAGE("relative differences: dq " << by_q << ", dqd " << by_qd);
  CHECK(by_q < 1e-9);
  CHECK(by_qd < 1e-9);
}
