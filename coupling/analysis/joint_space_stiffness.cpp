#include "coupling/analysis/joint_space_stiffness.h"

#include <array>
#include <cmath>

#include "solver/dynamics/dynamics.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "solver/model/configuration.h"

namespace twinarm {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Inverse dynamics at qdd = 0 gives bias - J^T f_ext: twice, for its difference.
VectorXd generalised_force(const Model<double>& model, const State<double>& x,
                           const Forces<double>& forces) {
  Workspace<double> w(model);
  const auto n = static_cast<Index>(model.nv);
  const std::vector<double> still(model.nv, 0.0);
  rnea(model, x, still, std::vector<Force<double>>(model.parent.size()), w);
  VectorXd tau = Eigen::Map<const VectorXd>(w.tau.data(), n);
  rnea(model, x, still, forces.f_ext, w);
  tau -= Eigen::Map<const VectorXd>(w.tau.data(), n);
  return tau + Eigen::Map<const VectorXd>(forces.tau.data(), n);
}

namespace {

// -(tau(x + s along dof) - tau(x - s)) / 2s, at steps that halve, extrapolated to order 6.
class TauRates {
 public:
  TauRates(const Model<double>& model, const State<double>& x, const PushesAt& push)
      : model_(model), x_(x), push_(push), k_(model) {}

  VectorXd along(std::size_t dof, bool of_velocity) {
    std::array<VectorXd, 3> rate{difference(dof, of_velocity, 4e-2),
                                 difference(dof, of_velocity, 2e-2),
                                 difference(dof, of_velocity, 1e-2)};
    for (std::size_t i = 0; i < 2; ++i) rate[i] = (4 * rate[i + 1] - rate[i]) / 3;
    return (16 * rate[1] - rate[0]) / 15;
  }

 private:
  VectorXd difference(std::size_t dof, bool of_velocity, double s) {
    return (at(dof, of_velocity, -s) - at(dof, of_velocity, s)) / (2 * s);
  }
  VectorXd at(std::size_t dof, bool of_velocity, double s) {
    State<double> x = x_;
    if (of_velocity) {
      x.qd[dof] += s;
    } else {
      std::vector<double> shift(model_.nv);
      shift[dof] = s;
      integrate_coordinates(model_, x_.q, shift, x.q);
    }
    forward_kinematics(model_, x, k_);
    Forces<double> forces(model_);
    push_(x, k_, forces);
    return generalised_force(model_, x, forces);
  }

  const Model<double>& model_;
  const State<double>& x_;
  const PushesAt& push_;
  Kinematics k_;
};

}  // namespace

TangentStiffness tangent_stiffness(const Model<double>& model, const State<double>& x,
                                   const PushesAt& push, std::size_t count) {
  const auto n = static_cast<Index>(model.nv);
  TangentStiffness found{MatrixXd::Zero(n, n), MatrixXd::Zero(n, n)};
  TauRates rates(model, x, push);
  for (std::size_t dof = 0; dof < count; ++dof) {
    found.K.col(static_cast<Index>(dof)) = rates.along(dof, false);
    found.B.col(static_cast<Index>(dof)) = rates.along(dof, true);
  }
  return found;
}

VectorXd squared_frequencies(const MatrixXd& M, const MatrixXd& K) {
  return generalized_eigenvalues(K, M);
}

double SpringModes::fastest_rate() const {
  return std::max(std::sqrt(squares.cwiseAbs().maxCoeff()), damping.cwiseAbs().maxCoeff());
}
double SpringModes::omega(Index i) const {
  return squares[i] > 0 ? std::sqrt(squares[i]) : 0;
}
double SpringModes::zeta(Index i) const {
  return squares[i] > 0 ? damping(i, i) / (2 * omega(i)) : 0;
}

// The directions that are held: of |K| and B, each brought to size 1, those that are not null.
SpringModes spring_modes(const MatrixXd& M, const MatrixXd& K, const MatrixXd& B) {
  constexpr double kNothing = 1e-10;
  const SymmetricEigensystem all = generalized_eigensystem((K + K.transpose()) / 2, M);
  const SymmetricEigensystem damped = generalized_eigensystem((B + B.transpose()) / 2, M);
  const double stiffest = all.values.cwiseAbs().maxCoeff();
  const double most_damped = damped.values.cwiseAbs().maxCoeff();
  std::vector<Index> kept;
  for (Index i = 0; i < all.values.size(); ++i) {
    const double b = all.vectors.col(i).dot(B * all.vectors.col(i));
    if ((stiffest > 0 && std::abs(all.values[i]) > kNothing * stiffest) ||
        (most_damped > 0 && std::abs(b) > kNothing * most_damped))
      kept.push_back(i);
  }
  SpringModes modes{VectorXd(kept.size()), MatrixXd(M.rows(), kept.size()), {}};
  for (std::size_t c = 0; c < kept.size(); ++c) {
    const auto column = static_cast<Index>(c);
    const double square = all.values[kept[c]];
    modes.squares[column] = std::abs(square) > kNothing * stiffest ? square : 0;
    modes.shapes.col(column) = all.vectors.col(kept[c]);
  }
  modes.damping = modes.shapes.transpose() * B * modes.shapes;
  return modes;
}

}  // namespace twinarm
