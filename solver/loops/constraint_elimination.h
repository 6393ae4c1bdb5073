// Solves M y = b + A^T lambda, A y = s within the articulated-body recursion, for rows A that have
// entries in few joints each (solver/passes/constraint_sweeps.h).
//
// At the body c where all their entries have been seen, a group of coupled rows e is eliminated:
//   K_e dv_c + G_ee lambda_e + G_eo lambda_o = s_e,
// o the rows that are still open there. lambda_e = G_ee^-1 (s_e - K_e dv_c - G_eo lambda_o) adds
// dIA = K_e^T G_ee^-1 K_e to IA and subtracts K_e^T G_ee^-1 s_e from p; K_o, G_oo and s_o decrease
// by G_oe G_ee^-1 (K_e, G_eo, s_e). G_ee is singular for redundant rows (pivoted_cholesky.h).
//
// Cost O(n + m) for m rows in loops of bounded size, also if they share joints. A group that is
// singular up to a small angle when all joints above it are locked costs digits, even if other
// rows determine its motion. No allocation after the constructor.
#pragma once

#include <vector>

#include "solver/linear_algebra/pivoted_cholesky.h"
#include "solver/model/constraint_workspace.h"

namespace twinarm {

class ConstraintElimination {
 public:
  // Of the couplings of rows, which grow with the square of the rows that are open at one joint.
  static constexpr std::size_t kMaxBytes = std::size_t{256} << 20;
  // dofs: those with entries, for each batch of four rows. The model must outlive it. Throws
  // InputError above kMaxBytes.
  ConstraintElimination(const Model<double>& model,
                        const std::vector<std::vector<std::size_t>>& dofs);

  // row: 4 batch + lane; k: index in dofs of the batch.
  void set_entry(std::size_t row, std::size_t k, double a) {
    set_lane(c_.f.E[entries_[row / 4][k]], row % 4, a);
  }
  double entry(std::size_t row, std::size_t k) const {
    return lane_of(c_.f.E[entries_[row / 4][k]], row % 4);
  }
  // Requires aba() at the same or a nearby q. held: dofs with y = 0.
  void factorise(const Workspace<double>& w, const std::vector<std::size_t>& held,
                 double tolerance) noexcept;
  void copy_factors(const ConstraintElimination& from) noexcept;
  std::size_t rank() const;
  const std::vector<std::size_t>& held() const { return held_; }

  void set_s(std::size_t row, double s) { set_lane(c_.s[number_[row / 4]], row % 4, s); }
  void solve(const std::vector<double>& b) noexcept;  // after set_s() of all rows
  double lambda(std::size_t row) const { return lane_of(c_.lambda[number_[row / 4]], row % 4); }
  const std::vector<double>& y() const { return c_.y; }
  const std::vector<Motion<double>>& dv() const { return c_.dv; }  // of the bodies, for qdd = y
  void minv_times(const std::vector<double>& b) noexcept;          // y = M^-1 b, no constraints

 private:
  using Rows = ConstraintWorkspace::Rows;
  using Lists = std::vector<std::vector<std::size_t>>;
  struct Group {  // coupled rows, eliminated at a body
    std::size_t body = 0, open = 0;
    std::vector<std::size_t> batch;  // o, as many as `open`, then e
    std::vector<std::size_t> K, G;   // indices: of K, of blocks of G for all pairs
    PivotedCholesky factors{0};
    std::vector<Force<double>> GinvK{};  // G_ee^-1 K_e
    std::vector<Rows> GinvG{};           // G_ee^-1 G_eo, by open batch
    std::size_t rows() const { return 4 * (batch.size() - open); }
    std::size_t batch_of(std::size_t row) const { return batch[open + row / 4]; }
  };
  struct Structure;
  const Rows& G_row(const Group& of, std::size_t row, std::size_t index) const;
  Force<double> row_of_K(const Group& of, std::size_t row) const;
  void factorise(Group& of, double tolerance);
  void eliminate(const Group& of);  // p and s
  void determine_multipliers(const Group& of);

  const Model<double>* model_;
  ConstraintWorkspace c_;
  std::vector<std::size_t> number_;  // of a batch in c_: ascending by the body that closes it
  Lists entries_;                    // indices of E
  std::vector<Group> groups_;        // descending by body
  std::vector<std::size_t> held_, body_of_dof_;
  std::vector<char> unchanged_;
  std::vector<double> size_, lambda_, work_;
  std::vector<Force<double>> K_, work_K_;
  std::vector<Rows> work_G_;
};

}  // namespace twinarm
