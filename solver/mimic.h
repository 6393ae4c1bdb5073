// Joints that follow others: qd_f = ratio qd_l and q_f = ratio q_l + offset (Model::mimics).
//
// Each is a constraint on velocities, A qd = 0 with the row a = e_f - ratio e_l. Its force acts
// along the row, RBDA section 8.3:
//   M qdd = tau - h + A^T lambda,   A qdd = 0   (A is constant: no velocity term),
// so that with qdd_free = M^-1 (tau - h)
//   (A M^-1 A^T) lambda = -A qdd_free.
// M^-1 A^T comes in O(n) a column (minv_times); the matrix on the left has one row per follower.
// A^T lambda does no work: qd^T A^T lambda = 0.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/dense_spd.h"
#include "solver/model.h"
#include "solver/workspace.h"

namespace twinarm {

// Places the followers, and sets their velocities, by their leaders.
void apply_mimics(const Model<double>& model, State<double>& x);

// qd = G y, y the velocities that follow nobody. The mass matrix in y is G^T M G, a generalised
// force b becomes G^T b: what acts on a follower counts through its ratio.
Eigen::MatrixXd mimic_projection(const Model<double>& model);           // G, nv x ny
std::vector<std::size_t> independent_dofs(const Model<double>& model);  // ny indices, ascending

// lambda for one state after another; sized once. After prepare(w) it knows M^-1 A^T.
class MimicForces {
 public:
  explicit MimicForces(const Model<double>& model);
  bool any() const { return !model_->mimics.empty(); }
  // After aba() at the same coordinates. Uses w.y, w.p, w.dv.
  void prepare(Workspace<double>& w) noexcept;
  // Sets lambda so that A (a + M^-1 b + M^-1 A^T lambda) = 0.
  void solve(const std::vector<double>& a, const std::vector<double>& b) noexcept;
  double acceleration(std::size_t dof) const;       // of M^-1 A^T lambda
  void add_forces(std::vector<double>& tau) const;  // A^T lambda
  // y, which is M^-1 b for some b, to what it is with the followers held to their leaders.
  void project(std::vector<double>& y) noexcept;

 private:
  const Model<double>* model_;
  DenseSpd S_;             // A M^-1 A^T
  std::vector<double> Z_;  // M^-1 A^T, one follower after the other
  std::vector<double> lambda_, b_;
  std::vector<Force<double>> no_forces_;
};

}  // namespace twinarm
