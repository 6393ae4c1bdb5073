// The passes for double. One translation unit per scalar.
#include "solver/aba.h"
#include "solver/crba.h"
#include "solver/rnea.h"

namespace twinarm {

template void aba(const Model<double>&, const State<double>&, const Forces<double>&,
                  Workspace<double>&);
template void rnea(const Model<double>&, const State<double>&, const std::vector<double>&,
                   const std::vector<Force<double>>&, Workspace<double>&);
template void crba(const Model<double>&, const State<double>&, Workspace<double>&,
                   Eigen::MatrixXd&);

}  // namespace twinarm
