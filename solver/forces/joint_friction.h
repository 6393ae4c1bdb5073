// Friction in joints: viscous, and Coulomb with its limits for either direction.
//
// On a dof with velocity v:  -b v,  and Coulomb friction f with
//   v > 0: f = -c_plus,   v < 0: f = +c_minus,   v = 0: f in [-c_plus, c_minus], whatever keeps it
// at rest. A follower's friction is felt by its leader through the ratio, so Coulomb friction is
// that of the dofs that follow nobody: the sum over each family.
//
// At rest the frictions of several dofs depend on one another: with B the part of M^-1 that belongs
// to them and a their acceleration without friction, they solve
//   v' = a + B f,   low <= f <= high,   v' > 0 only where f = low, v' < 0 only where f = high,
// a linear complementarity problem in a box. B is positive definite, so there is one solution.
#pragma once

#include <vector>

#include "solver/linear_algebra/dense_spd.h"
#include "solver/model/model.h"

namespace twinarm {

// Solved by block principal pivoting: guess who is inside of its bounds, solve for those, exchange
// all that contradict. Where that does not lessen the contradictions, only one is exchanged at a
// time (the last), which ends after finitely many pivots for every positive definite B (Murty
// 1974; Judice and Pires, Computers & Operations Research 21, 1994: blocks with this fallback).
// Chosen as it is exact (one solve with the right guess, which mostly is the first or second one)
// and warm-start free, so the same inputs give the same bits. Pivots are bounded; should that not
// do, projected Gauss-Seidel goes on to rounding.
class BoxLcp {
 public:
  static constexpr double kRounding = 1e-13;  // relative: contradictions up to this are rounding
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
  std::vector<Row> rows;  // their number: the size of the problem
  double& B(std::size_t i, std::size_t j) { return B_(i, j); }  // both triangles
  // True where pivoting came to its end.
  bool solve() noexcept;
  bool solve_by_gauss_seidel() noexcept;  // true where it came down to rounding

 private:
  void solve_inside();
  bool contradicts(std::size_t i, At& better) const;
  double result(std::size_t i, double& size) const;  // v' of row i, and the size of its terms

  DenseSpd B_, factors_;
  std::vector<double> rhs_;
  std::vector<std::size_t> inside_;
};

// The Coulomb friction of a model, dof by dof that follows nobody and has any.
class CoulombFriction {
 public:
  struct MimicGroup {
    std::size_t dof;           // the leader's
    double plus, minus;        // limits of the friction felt there: it lies in [-plus, minus]
    std::size_t first, count;  // its members
  };
  explicit CoulombFriction(const Model<double>& model);
  const std::vector<MimicGroup>& families() const { return families_; }
  // Adds what friction f felt at the leader is in each joint of the family: parts of their limits
  // that are all the same.
  void distribute(std::size_t family, double f, std::vector<double>& tau) const;

 private:
  struct Member {
    std::size_t dof;
    double plus, minus;  // torque on the dof itself when f = -plus, f = minus of the family
  };
  std::vector<MimicGroup> families_;
  std::vector<Member> members_;
};

}  // namespace twinarm
