// Spatial vectors of all velocities in the common axes of Workspace::Xr, as six rows of numbers:
// loops over the velocities of a chain then use whole vector registers.
#pragma once

#include <array>
#include <vector>

#include "solver/model/model.h"
#include "solver/spatial/instruction_set.h"

namespace twinarm {

// The six numbers of a motion (w, v) or force (n, f).
template <class S>
using Six = std::array<S, 6>;
template <class S>
Six<S> six(const Motion<S>& m) {
  return {m.w.x, m.w.y, m.w.z, m.v.x, m.v.y, m.v.z};
}
template <class S>
Six<S> six(const Force<S>& f) {
  return {f.n.x, f.n.y, f.n.z, f.f.x, f.f.y, f.f.z};
}

template <class S>
class SpatialRows {
 public:
  explicit SpatialRows(std::size_t nv) {
    for (std::vector<S>& numbers : rows_) numbers.resize(nv);
  }
  void set(std::size_t k, const Six<S>& a) {
    for (std::size_t c = 0; c < 6; ++c) rows_[c][k] = a[c];
  }
  Motion<S> motion(std::size_t k) const {
    return {{rows_[0][k], rows_[1][k], rows_[2][k]}, {rows_[3][k], rows_[4][k], rows_[5][k]}};
  }
  std::array<S*, 6> pointers() {
    return {rows_[0].data(), rows_[1].data(), rows_[2].data(),
            rows_[3].data(), rows_[4].data(), rows_[5].data()};
  }

 private:
  std::array<std::vector<S>, 6> rows_;
};

// a . (column k of the rows): power of a force along motion k, or of force k along a motion. By
// value: the compiler need not reload them after each result that it writes.
template <class S>
S dot(Six<S> a, std::array<S*, 6> rows, std::size_t k) {
  return a[0] * rows[0][k] + a[1] * rows[1][k] + a[2] * rows[2][k] + a[3] * rows[3][k] +
         a[4] * rows[4][k] + a[5] * rows[5][k];
}
// rows += a factors^T
template <class S>
void add_outer(Six<S> a, const S* factors, DofRange of, std::array<S*, 6> rows) {
  TWINARM_INDEPENDENT
  for (std::size_t k = of.first; k < of.end; ++k) {
    const S factor = factors[k];
    for (std::size_t c = 0; c < 6; ++c) rows[c][k] = rows[c][k] + a[c] * factor;
  }
}

// Calls visit with the ranges of velocities of the ancestors of body i: one for each chain.
template <class S, class F>
void visit_ancestors(const Model<S>& model, std::size_t i, F&& visit) {
  for (int last = model.parent[i]; last > 0;) {
    const auto end = static_cast<std::size_t>(last), first = model.chain_first[end];
    visit(DofRange{model.iv[first], model.iv[end] + model.dofs(end)});
    last = model.parent[first];
  }
}

// X^-1 m: from the axes of a body, X its Workspace::Xr, to the common axes.
template <class S>
Motion<S> to_common_axes(const Transform<S>& X, const Motion<S>& m) {
  const Vec3<S> w = transpose_times(X.E, m.w);
  return {w, plus_cross(transpose_times(X.E, m.v), X.r, w)};
}

}  // namespace twinarm
