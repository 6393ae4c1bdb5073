#include "solver/dynamics/derivatives.h"

namespace twinarm {

ForwardDynamicsDerivatives forward_dynamics_derivatives(const Model<double>& model,
                                                        const State<double>& x,
                                                        const Forces<double>& forces) {
  Workspace<double> w(model);
  MatrixWorkspace<double> m(model);
  aba(model, x, forces, w);
  AbaDerivatives<double> all(model);
  aba_derivatives(model, x, forces, w, m, all);
  const auto n = static_cast<Eigen::Index>(model.nv);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> both(all.dqdd.data(), n, 2 * n);
  return {both.leftCols(n), both.rightCols(n)};
}

}  // namespace twinarm
