// The mass matrix M(q) as an Eigen matrix, by CRBA, for analyses: allocates.
#pragma once

#include <Eigen/Core>

#include "solver/model/workspace.h"

namespace twinarm {

Eigen::MatrixXd mass_matrix(const Model<double>& model, const State<double>& x);

}  // namespace twinarm
