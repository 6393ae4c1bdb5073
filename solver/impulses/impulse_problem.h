// The velocities at the end of a step under impulses that obey laws: contacts with exact Coulomb
// friction, limits, locks, dry friction.
//
//   M (v - v0) = sum_i J_i^T p_i,     u_i = J_i v + b_i,     (u_i, p_i) obey the law of i.
//
// M is block diagonal: one dense block for each tree of the mechanism (a free body is a tree of its
// own), so that a pile of a thousand bodies costs no more than its contacts. v0 are the velocities
// without the impulses. Nothing here knows of geometry or time. No allocation once warm.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace twinarm {

enum class ConstraintType : unsigned char {
  bilateral,      // u = 0                                                       1 to 3 rows
  unilateral,     // u >= 0, p >= 0, u p = 0: a limit, a contact without friction  1 row
  box,            // p in [low, high]; u > 0 only at low, u < 0 only at high      1 row
  friction_disc,  // |p| <= radius p_n of the contact `of`; slides against p       1 or 2 rows
                  // (the contact comes before it, and is between the same trees)
  coulomb_cone,   // row 0 normal: unilateral; rows 1, 2: |p_t| <= mu p_n, slides against p_t
  compliant       // spring-damper instead of unilateral, and bristles that slide at mu p_n (3 rows)
};

struct ImpulseConstraint {
  static constexpr int no_tree = -1;
  ConstraintType law = ConstraintType::bilateral;
  int rows = 1;
  std::array<int, 2> tree{no_tree, no_tree};
  std::array<std::size_t, 2> J{};  // where the rows x n block of either tree begins
  std::array<double, 3> b{};       // [m/s], or [rad/s]
  std::array<double, 3> p{};       // in: a guess, such as that of the step before; out [N s]
  std::array<double, 3> u{};       // out
  double mu = 0;                   // coulomb, compliant
  double low = 0, high = 0;        // within [N s]
  double radius = 0;               // disc [m]
  int of = -1;                     // disc: index of its contact

  // compliant: p_n = h k (d + h s)(1 + c s) where both are positive, s = -u_n (Hunt, Crossley
  // 1975);
  //            p_t = -h (k_t (a + h u_t) + b_t u_t), no longer than mu p_n.
  double h = 0, k = 0, c = 0, depth = 0;
  double k_t = 0, b_t = 0;
  std::array<double, 2> anchor{};  // a: how far the bristles are bent at the start [m]
};

class ImpulseProblem {
 public:
  void clear();
  // A block of M with n rows; returns its index. Fill M(tree) and v0(tree).
  int add_tree(int n);
  // A law between two trees (or one, or none: ImpulseConstraint::no_tree). J blocks are zero.
  ImpulseConstraint& add(ConstraintType law, int rows, int tree_a, int tree_b);

  int tree_count() const { return static_cast<int>(size_.size()); }
  int size(int tree) const { return size_[tree]; }
  std::size_t first(int tree) const { return first_[tree]; }  // its place in v
  double* M(int tree) { return M_.data() + block_[tree]; }    // row by row, symmetric
  const double* M(int tree) const { return M_.data() + block_[tree]; }
  double* v0(int tree) { return v0_.data() + first_[tree]; }
  const double* v0(int tree) const { return v0_.data() + first_[tree]; }
  double* v(int tree) { return v_.data() + first_[tree]; }  // the solution
  const double* v(int tree) const { return v_.data() + first_[tree]; }
  // Of constraint c, side 0 or 1: rows x size(tree), row by row.
  double* J(const ImpulseConstraint& c, int side) { return J_.data() + c.J[side]; }
  const double* J(const ImpulseConstraint& c, int side) const { return J_.data() + c.J[side]; }
  std::vector<ImpulseConstraint>& constraints() { return constraints_; }
  const std::vector<ImpulseConstraint>& constraints() const { return constraints_; }
  std::size_t block(int tree) const { return block_[tree]; }  // where M(tree) begins
  std::size_t blocks_size() const { return M_.size(); }
  std::size_t nv() const { return v0_.size(); }

  // u = J v (without b) for any v; 0 for rows that are not there.
  void velocity(const ImpulseConstraint& c, const double* v, std::array<double, 3>& u) const;
  // f += J^T p
  void add_transpose(const ImpulseConstraint& c, const std::array<double, 3>& p, double* f) const;

 private:
  std::vector<int> size_;
  std::vector<std::size_t> first_, block_;
  std::vector<double> M_, v0_, v_, J_;
  std::vector<ImpulseConstraint> constraints_;
};

}  // namespace twinarm
