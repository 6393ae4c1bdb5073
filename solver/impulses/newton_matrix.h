// Matrix M + J^T D J of one island, factorised by its envelope (envelope_lu.h) in the reverse
// Cuthill-McKee order of the trees. M makes it positive definite for redundant contacts too.
#pragma once

#include "solver/impulses/impulse_island.h"
#include "solver/linear_algebra/envelope_lu.h"

namespace twinarm {

class NewtonMatrix {
 public:
  // Order of the trees, and the work of a step.
  void set(ImpulseIsland& island);
  // From D and coupling of the island. Symmetric: D is, and only the lower triangle is set. False:
  // singular.
  bool factorise(bool symmetric);
  void solve(std::vector<double>& x);  // x := matrix^-1 x, by velocity of the problem
  int determinant_sign() const { return matrix_.determinant_sign(); }
  double work() const { return work_; }  // floating-point operations of factorise(false), about

 private:
  // f(index in v, row) for each velocity of the island.
  template <class F>
  void for_each_row(F&& f) const {
    for (const int t : island_->trees())
      for (std::size_t k = 0; k < static_cast<std::size_t>(problem_->size(t)); ++k)
        f(problem_->first(t) + k, row_[t] + k);
  }
  void find_rows();
  void count_work();
  void set_envelope();
  void add_products(const ImpulseConstraint& left, const ImpulseConstraint& right, const Mat& D,
                    bool symmetric);
  void add_block(const ImpulseConstraint& left, int side_s, const ImpulseConstraint& right,
                 int side_t, bool symmetric);

  ImpulseIsland* island_ = nullptr;
  ImpulseProblem* problem_ = nullptr;
  EnvelopeLu matrix_;
  bool has_envelope_ = false;     // matrix_ has that of the current island
  std::vector<std::size_t> row_;  // by tree: first row
  std::vector<int> neighbour_begin_, neighbours_, order_, lowest_;
  std::vector<double> rhs_, DJ_;
  double work_ = 0;
};

}  // namespace twinarm
