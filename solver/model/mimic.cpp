#include "solver/model/mimic.h"

#include <algorithm>

namespace twinarm {

void apply_mimics(const Model<double>& model, State<double>& x) {
  for (const Mimic& m : model.mimics) {
    x.q[m.follower_q] = m.ratio * x.q[m.leader_q] + m.offset;
    x.qd[m.follower] = m.ratio * x.qd[m.leader];
  }
}

std::vector<std::size_t> independent_dofs(const Model<double>& model) {
  std::vector<std::size_t> dofs;
  for (std::size_t d = 0; d < model.nv; ++d)
    if (std::ranges::find(model.mimics, d, &Mimic::follower) == model.mimics.end())
      dofs.push_back(d);
  return dofs;
}

Eigen::SparseMatrix<double> mimic_projection(const Model<double>& model) {
  const std::vector<std::size_t> independent = independent_dofs(model);
  const auto index = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
  Eigen::SparseMatrix<double> G(index(model.nv), index(independent.size()));
  for (std::size_t y = 0; y < independent.size(); ++y) {
    G.insert(index(independent[y]), index(y)) = 1;
    for (const Mimic& m : model.mimics)
      if (m.leader == independent[y]) G.insert(index(m.follower), index(y)) = m.ratio;
  }
  return G;
}

}  // namespace twinarm
