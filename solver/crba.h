// The mass matrix by the composite-rigid-body algorithm, RBDA section 6.2, table 6.2.
//
// Writes M, nv x nv, both triangles. Uses Ic, Xup of the workspace. O(n depth).
#pragma once

#include <Eigen/Core>

#include "solver/slice.h"
#include "solver/workspace.h"

namespace twinarm {

template <class S>
void crba(const Model<S>& model, const State<S>& x, Workspace<S>& w,
          Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>& M) {
  const std::size_t n_bodies = model.parent.size();
  const auto at = [](std::size_t k) { return static_cast<Eigen::Index>(k); };
  forget(w.Ic);
  M.setZero(at(model.nv), at(model.nv));

  for (std::size_t i = 1; i < n_bodies; ++i) {
    visit_joint<S>(model.joint[i], [&](auto joint) {
      w.Xup[i] = joint.XJ(x.q.data() + model.iq[i]) * model.Xtree[i];
      w.Ic[i] = ArticulatedInertia<S>(model.I[i]);
    });
  }

  for (std::size_t i = n_bodies; i-- > 1;) {
    visit_joint<S>(model.joint[i], [&](auto joint_i) {
      auto F = w.Ic[i] * joint_i.subspace;
      const std::size_t iv = model.iv[i];
      if (model.parent[i] > 0)
        w.Ic[static_cast<std::size_t>(model.parent[i])] += congruence(w.Xup[i], w.Ic[i]);

      // M_ji = S_j^T F_i for j = i and every ancestor j of i
      for (std::size_t j = i; j > 0; j = static_cast<std::size_t>(model.parent[j])) {
        visit_joint<S>(model.joint[j], [&](auto joint_j) {
          const std::size_t jv = model.iv[j];
          for (std::size_t c = 0; c < F.size(); ++c) {
            const auto entries = transpose_times(joint_j.subspace, F[c]);
            for (std::size_t r = 0; r < entries.size(); ++r)
              M(at(jv + r), at(iv + c)) = M(at(iv + c), at(jv + r)) = entries[r];
          }
        });
        for (auto& column_of_F : F) column_of_F = transpose_times(w.Xup[j], column_of_F);
      }
    });
  }
}

extern template void crba(const Model<double>&, const State<double>&, Workspace<double>&,
                          Eigen::MatrixXd&);

}  // namespace twinarm
