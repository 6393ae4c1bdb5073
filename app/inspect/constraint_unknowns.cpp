#include "app/inspect/constraint_unknowns.h"

#include "solver/linear_algebra/dense_algebra.h"

namespace twinarm {

void ConstraintUnknowns::mark(std::vector<AppliedForce>& actors) const {
  constexpr double kTolerance = 1e-6;
  Eigen::Index count = 0;
  for (const Unknowns& of : all_) count += of.by_velocity.cols();
  if (count == 0 || count > kMax) return;
  Eigen::MatrixXd A(all_.front().by_velocity.rows(), count);
  Eigen::Index column = 0;
  for (const Unknowns& of : all_) {
    A.middleCols(column, of.by_velocity.cols()) = of.by_velocity;
    column += of.by_velocity.cols();
  }
  const Eigen::VectorXd part = undetermined_part(A, 1e-9);
  column = 0;
  for (const Unknowns& of : all_) {
    const auto own = part.segment(column, of.by_velocity.cols());
    if (of.actor && (own.array() > kTolerance).any()) actors[*of.actor].is_unique = false;
    column += of.by_velocity.cols();
  }
}

}  // namespace twinarm
