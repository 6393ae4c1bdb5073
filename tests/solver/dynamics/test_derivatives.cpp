// Derivatives of inverse and forward dynamics against dual numbers and finite differences.
#include "solver/dynamics/derivatives.h"
#include "solver/dynamics/dynamics.h"
#include "solver/linear_algebra/dense_algebra.h"

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

using D = Dual<8>;
constexpr std::size_t kDirections = 8;

Forces<D> convert_forces(const Model<D>& model, const Forces<double>& forces) {
  Forces<D> out(model);
  for (std::size_t k = 0; k < model.nv; ++k) {
    out.tau[k] = forces.tau[k];
    out.armature[k] = forces.armature[k];
  }
  for (std::size_t i = 0; i < model.parent.size(); ++i) {
    out.f_ext[i] = {convert<D>(forces.f_ext[i].n), convert<D>(forces.f_ext[i].f)};
    if (forces.has_added_inertia)
      out.add_inertia(i,
                      {convert<D>(forces.added_inertia[i].I), convert<D>(forces.added_inertia[i].H),
                       convert<D>(forces.added_inertia[i].M)});
  }
  return out;
}

// By aba() of dual numbers.
ForwardDynamicsDerivatives derivatives_by_duals(const Model<double>& model, const State<double>& x,
                                                const Forces<double>& forces) {
  const auto n = static_cast<Eigen::Index>(model.nv);
  ForwardDynamicsDerivatives out{Eigen::MatrixXd(n, n), Eigen::MatrixXd(n, n)};
  const Model<D> dual_model = convert<D>(model);
  const Forces<D> dual_forces = convert_forces(dual_model, forces);
  Workspace<D> w(dual_model);

  const auto differentiate = [&](Eigen::MatrixXd& derivative, auto&& seed) {
    for (std::size_t first = 0; first < model.nv; first += kDirections) {
      State<D> at = convert<D>(x);
      std::vector<D> delta(model.nv);
      const std::size_t count = std::min(kDirections, model.nv - first);
      for (std::size_t k = 0; k < count; ++k) seed(at, delta, first + k, static_cast<int>(k));
      for (std::size_t i = 1; i < model.parent.size(); ++i)
        visit_joint(dual_model, i, [&](auto joint) {
          joint.integrate(at.q.data() + model.iq[i], delta.data() + model.iv[i],
                          at.q.data() + model.iq[i]);
        });
      aba(dual_model, at, dual_forces, w);
      for (std::size_t row = 0; row < model.nv; ++row)
        for (std::size_t k = 0; k < count; ++k)
          derivative(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(first + k)) =
              w.qdd[row].d[static_cast<int>(k)];
    }
  };
  using Numbers = std::vector<D>;
  differentiate(out.dq,
                [](State<D>&, Numbers& delta, std::size_t dof, int k) { delta[dof].d[k] = 1; });
  differentiate(out.dqd,
                [](State<D>& at, Numbers&, std::size_t dof, int k) { at.qd[dof].d[k] = 1; });
  return out;
}

// Random tree, state and forces, every second with added inertia.
struct Example {
  Model<double> model;
  State<double> x;
  Forces<double> forces;
  Example(Random& random, int n, const std::vector<JointType>& types)
      : model(random_tree(random, random.integer(1, 9), types)),
        x(random_state(random, model)),
        forces(random_forces(random, model)) {
    for (double& armature : forces.armature) armature = random.uniform(0, 1);
    if (n % 2)
      for (std::size_t i = 1; i < model.parent.size(); ++i)
        forces.add_inertia(i, ArticulatedInertia<double>(model.I[i]));
  }
};

}  // namespace

TEST_CASE("derivatives of qdd by q and qd agree with finite differences, for every joint") {
  Random random(1);
  double by_q = 0, by_qd = 0;
  for (const auto& types : lists_of_types())
    for (int n = 0; n < 8; ++n) {
      const Example example(random, n, types);
      const auto& model = example.model;
      const auto& x = example.x;
      const auto& forces = example.forces;
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

TEST_CASE("derivatives of qdd equal those of dual numbers to 5 eps cond(M), at every level") {
  Random random(2);
  double worst = 0;
  for (const auto& types : lists_of_types())
    for (int n = 0; n < 20; ++n) {
      const Example example(random, n, types);
      const auto& model = example.model;
      const auto& x = example.x;
      const auto& forces = example.forces;
      if (model.nv == 0) continue;
      const ForwardDynamicsDerivatives duals = derivatives_by_duals(model, x, forces);
      for (const Isa isa : levels_of<double>()) {
        Workspace<double> w(model);
        MatrixWorkspace<double> m(model);
        AbaDerivatives<double> all(model);
        passes<double>(isa).aba(model, x, forces, w);
        passes<double>(isa).aba_derivatives(model, x, forces, w, m, all);
        const auto nv = static_cast<Eigen::Index>(model.nv);
        const Eigen::MatrixXd both = lane_of(all.dqdd, 0).reshaped(2 * nv, nv).transpose();
        const Eigen::VectorXd eigenvalues = symmetric_eigenvalues(square_of(all.Minv, model.nv, 0));
        const Eigen::MatrixXd dtau = lane_of(all.dtau, 0).reshaped(2 * nv, nv).transpose();
        const double largest = eigenvalues.maxCoeff(),
                     rounding = std::numeric_limits<double>::epsilon() * largest * largest /
                                eigenvalues.minCoeff();
        worst = std::max(
            {worst,
             (both.leftCols(nv) - duals.dq).norm() / (rounding * (dtau.leftCols(nv).norm() + 1)),
             (both.rightCols(nv) - duals.dqd).norm() /
                 (rounding * (dtau.rightCols(nv).norm() + 1))});
      }
    }
  MESSAGE("largest difference: " << worst << " eps cond(M)");
  CHECK(worst <= 5);
}
