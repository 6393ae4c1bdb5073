// Joint friction: viscous, and Coulomb with a limit for each direction.
//
// For a joint velocity v: damping -b v, and Coulomb friction f with
//   v > 0: f = -c_plus,   v < 0: f = +c_minus,   v = 0: f in [-c_plus, c_minus].
// Friction of a mimic joint acts on the independent joint through the ratio; limits are summed over
// the mimic group.
//
// Sticking joints are coupled: with B their block of M^-1 and a their acceleration without
// friction, f solves a box-constrained linear complementarity problem,
//   v' = a + B f,   low <= f <= high,   v' > 0 only if f = low,   v' < 0 only if f = high.
// B is positive definite: the solution is unique.
#pragma once

#include <vector>

#include "solver/linear_algebra/dense_spd.h"
#include "solver/model/model.h"

namespace twinarm {

// Block principal pivoting: guess the set of rows inside their bounds, solve for these, exchange
// all rows that contradict. If their number does not decrease, only the last one is exchanged,
// which is finite for positive definite B (Murty 1974; Judice and Pires, Computers & Operations
// Research 21, 1994: block pivoting with this fallback). Exact and independent of earlier steps.
// The number of pivots is bounded; beyond it projected Gauss-Seidel iterates to rounding.
class BoxLcp {
 public:
  static constexpr double kRounding = 1e-13;  // relative tolerance of contradictions
  enum class At : signed char { low, inside, high };
  struct Row {
    double a = 0, low = 0, high = 0;  // given
    double f = 0;                     // found
    At at = At::inside;
  };

  explicit BoxLcp(std::size_t capacity) : B_(capacity), factors_(capacity), rhs_(capacity) {
    rows.reserve(capacity);
    inside_.reserve(capacity);
  }
  std::vector<Row> rows;
  double& B(std::size_t i, std::size_t j) { return B_(i, j); }  // both triangles
  bool solve() noexcept;                                        // true if pivoting terminated
  bool solve_by_gauss_seidel() noexcept;                        // true if converged to rounding

 private:
  bool solve_inside();
  bool contradicts(std::size_t i, At& better) const;
  double result(std::size_t i, double& size) const;  // v' of row i; size: sum of |terms|

  DenseSpd B_, factors_;
  std::vector<double> rhs_;
  std::vector<std::size_t> inside_;
};

// Coulomb friction of a model, by mimic group: an independent joint and the joints that mimic it.
class CoulombFriction {
 public:
  struct MimicGroup {
    std::size_t dof;           // of the independent joint
    double plus, minus;        // friction reflected to dof lies in [-plus, minus]
    std::size_t first, count;  // members
  };
  explicit CoulombFriction(const Model<double>& model);
  const std::vector<MimicGroup>& groups() const { return groups_; }
  // Adds the joint forces of friction f at the independent joint: the same fraction of the limit in
  // each joint of the group.
  void distribute(std::size_t group, double f, std::vector<double>& tau) const;

 private:
  struct Member {
    std::size_t dof;
    double plus, minus;  // joint force for f = -plus and f = minus of the group
  };
  std::vector<MimicGroup> groups_;
  std::vector<Member> members_;
};

}  // namespace twinarm
