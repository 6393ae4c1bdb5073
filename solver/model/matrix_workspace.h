// Variables of the algorithms whose results are matrices: derivatives and inverse mass matrix.
// Allocated once. In the common axes of Workspace::Xr.
#pragma once

#include <array>
#include <vector>

#include "solver/model/spatial_rows.h"
#include "solver/model/workspace.h"

namespace twinarm {

// Sums over the bodies of a subtree, of solver/passes/rnea_derivatives.h.
template <class S>
struct SubtreeSums {
  Inertia<S> I;
  Force<S> f;  // wrench that the subtree needs
  Vec3<S> P;   // linear momentum
  Mat3<S> R;   // sum of m v r^T over points
  // with added inertia only
  ArticulatedInertia<S> A;
  std::array<Force<S>, 6> A_crm;  // columns of the sum of A (v x)

  void add(const SubtreeSums& child, bool has_added_inertia) {
    I += child.I, f += child.f, P += child.P, R += child.R;
    if (!has_added_inertia) return;
    A += child.A;
    for (std::size_t k = 0; k < 6; ++k) A_crm[k] += child.A_crm[k];
  }
};

// Results of aba_derivatives(), row-major.
template <class S>
struct AbaDerivatives {
  std::vector<S> dqdd;  // (d qdd/dq, d qdd/dqd), nv x 2 nv
  std::vector<S> Minv;  // d qdd/d tau, nv x nv
  std::vector<S> dtau;  // of inverse dynamics at qdd: (d tau/dq, d tau/dqd), nv x 2 nv

  explicit AbaDerivatives(const Model<S>& model)
      : dqdd(2 * model.nv * model.nv), Minv(model.nv * model.nv), dtau(dqdd.size()) {}
};

template <class S>
struct MatrixWorkspace {
  // derivatives, by body
  std::vector<Motion<S>> v, a;
  std::vector<SubtreeSums<S>> sums;
  // by velocity
  SpatialRows<S> axes, dS, ddS, sS;
  // inverse mass matrix, by velocity
  std::vector<Six<S>> S_, U, DinvS, DinvU;  // columns of S and U, rows of D^-1 S^T and D^-1 U^T
  SpatialRows<S> F;                         // wrench at the root of the subtree, by column
  std::vector<SpatialRows<S>> P;            // acceleration of a body with children, by column
  std::vector<std::size_t> iP;              // index in P of such a body; last children reuse one
  std::vector<S> no_armature;               // zeros
  // tree
  std::vector<std::vector<DofRange>> below;  // velocities of the descendants of a body

  explicit MatrixWorkspace(const Model<S>& model);
};

template <class S>
MatrixWorkspace<S>::MatrixWorkspace(const Model<S>& model)
    : v(model.parent.size()),
      a(v.size()),
      sums(v.size()),
      axes(model.nv),
      dS(model.nv),
      ddS(model.nv),
      sS(model.nv),
      S_(model.nv),
      U(model.nv),
      DinvS(model.nv),
      DinvU(model.nv),
      F(model.nv),
      iP(v.size()),
      no_armature(model.nv),
      below(v.size()) {
  for (std::size_t i = 1; i < v.size(); ++i) {
    const auto p = static_cast<std::size_t>(model.parent[i]);
    const std::size_t first = model.iv[i], end = first + model.dofs(i);
    for (std::size_t j = p; j > 0; j = static_cast<std::size_t>(model.parent[j])) {
      if (!below[j].empty() && below[j].back().end == first)
        below[j].back().end = end;
      else if (first < end)
        below[j].push_back({first, end});
    }
    if (model.last_child[i] == 0) continue;
    if (p > 0 && model.last_child[p] == static_cast<int>(i)) {
      iP[i] = iP[p];
    } else {
      iP[i] = P.size();
      P.emplace_back(model.nv);
    }
  }
}

}  // namespace twinarm
