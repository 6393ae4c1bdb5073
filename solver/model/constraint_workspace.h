// Variables of constraint_sweeps.h: rows A of constraints, eliminated within the articulated-body
// recursion. Four rows are the lanes of a batch. Allocated once.
#pragma once

#include <array>
#include <vector>

#include "solver/model/workspace.h"
#include "solver/spatial/batch.h"

namespace twinarm {

struct ConstraintWorkspace {
  using Rows = Batch<4>;
  using Block = std::array<Rows, 4>;  // of two batches: row of the first, lane of the second

  // Structure. A batch is open at joint i if A has entries both in the subtree of body i and
  // outside, and closed at the deepest body with all its entries below.
  struct Front {
    std::size_t first = 0;  // of K of this body: batches that are open, then those closed at it
    std::size_t open = 0;
    std::size_t entry = 0;  // of E and Y: entry + (number of the open batch) dofs + dof
    std::size_t pair = 0;   // of block: open batches j, and of each those up to it
  };
  std::vector<Front> fronts;       // by body
  std::vector<std::size_t> batch;  // by K
  std::vector<std::size_t> above;  // by K: K of this batch at the parent
  std::vector<char> is_first;      // by K: the first term of the parent's
  std::vector<std::size_t> block;  // of G, by pair

  struct Factors {
    // of aba(); U and D_factors are increased by dIA in changed_U and changed_D
    std::vector<Transform<double>> Xup;
    std::vector<Motion<double>> S_;
    std::vector<Force<double>> U, changed_U;
    std::vector<double> D_factors, changed_D;
    std::vector<std::size_t> iD;
    std::vector<char> is_changed;  // by body
    std::vector<Rows> E, Y;        // entries of A; D^-1 (K S + E)
    std::vector<Force<Rows>> K;    // rows as forces: K . a_i
    std::vector<Block> G;          // A M^-1 A^T, M of the subtree in which the rows are open
  } f;
  std::vector<ArticulatedInertia<double>> dIA;  // by body, if is_changed
  std::vector<char> is_held;                    // by velocity
  std::vector<Rows> KS;                         // K S + E of one joint
  std::vector<Rows> size, s, lambda;            // by batch; size: diagonal of G, nothing eliminated
  std::vector<Force<double>> p;
  std::vector<Motion<double>> dv;
  std::vector<double> y;

  void add_inertia(std::size_t i, const Transform<double>& X,
                   const ArticulatedInertia<double>& more) {
    if (!f.is_changed[i]) dIA[i] = ArticulatedInertia<double>{};
    f.is_changed[i] = 1;
    add_congruence(X, more, dIA[i], dIA[i]);
  }
};

}  // namespace twinarm
