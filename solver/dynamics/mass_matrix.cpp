#include "solver/dynamics/mass_matrix.h"

#include "solver/dynamics/dynamics.h"

namespace twinarm {

Eigen::MatrixXd mass_matrix(const Model<double>& model, const State<double>& x) {
  Workspace<double> w(model);
  const auto n = static_cast<Eigen::Index>(model.nv);
  Eigen::MatrixXd M(n, n);
  crba(model, x, w, {M.data(), model.nv * model.nv});  // symmetric: by rows is by columns
  return M;
}

}  // namespace twinarm
