#include "solver/dynamics/mass_matrix.h"

#include "solver/dynamics/dynamics.h"

namespace twinarm {

Eigen::MatrixXd mass_matrix(const Model<double>& model, const State<double>& x) {
  Workspace<double> w(model);
  crba(model, x, w);
  const auto n = static_cast<Eigen::Index>(model.nv);
  return Eigen::Map<const Eigen::MatrixXd>(w.M.data(), n, n);  // symmetric
}

}  // namespace twinarm
