// Which constraint forces the equations of motion determine. Constraint forces x enter as A x; if A
// has a null space, single forces are not unique (four corners of a resting block, redundant
// loops), though their sum on each body is.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "app/inspect/inspection.h"

namespace twinarm {

class ConstraintUnknowns {
 public:
  // Unknowns of one force: `by_velocity` (nv, n) is the generalised force of each unit force. No
  // actor: it is only balanced against (mimic joints).
  void add(std::optional<std::size_t> actor, Eigen::MatrixXd by_velocity) {
    all_.push_back({actor, std::move(by_velocity)});
  }
  // Sets is_unique of the actors, by a QR factorization; beyond kMax unknowns it sets none.
  void mark(std::vector<AppliedForce>& actors) const;
  static constexpr Eigen::Index kMax = 300;

 private:
  struct Unknowns {
    std::optional<std::size_t> actor;
    Eigen::MatrixXd by_velocity;
  };
  std::vector<Unknowns> all_;
};

}  // namespace twinarm
