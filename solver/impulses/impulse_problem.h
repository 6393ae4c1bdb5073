// Velocities at the end of a step under constraint impulses: contacts with exact Coulomb friction,
// limits, locks, joint friction.
//
//   M (v - v0) = sum_i J_i^T p_i,     u_i = J_i v + b_i,     (u_i, p_i) satisfy the law of i.
//
// M is block diagonal: one dense block per kinematic tree (a free body is a tree), so that the cost
// of a pile grows with its contacts. v0: velocities without impulses. Independent of geometry and
// time. No allocation after the first solutions.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace twinarm {

enum class ConstraintType : unsigned char {
  bilateral,      // 1 to 3 rows: u = 0
  unilateral,     // 1 row: u >= 0, p >= 0, u p = 0 (limit, frictionless contact)
  box,            // 1 row: p in [low, high]; u > 0 only at low, u < 0 only at high
  friction_disc,  // 1 or 2 rows: |p| <= radius p_n of contact `of`; slides against p. The contact
                  // precedes it and is between the same trees
  coulomb_cone,  // 3 rows: row 0 normal, unilateral; rows 1, 2: |p_t| <= mu p_n, slides against p_t
  compliant      // 3 rows: Hunt-Crossley normal force, bristle friction bounded by mu p_n
};

struct ImpulseConstraint {
  static constexpr int no_tree = -1;
  ConstraintType law = ConstraintType::bilateral;
  int rows = 1;
  std::array<int, 2> tree{no_tree, no_tree};
  std::array<std::size_t, 2> J{};  // first index of the rows x n block of each tree
  std::array<double, 3> b{};       // velocity bias [m/s, rad/s]
  std::array<double, 3> p{};       // in: initial guess; out: impulse [N s, N m s]
  std::array<double, 3> u{};       // out: velocity
  double mu = 0;                   // coulomb_cone, compliant
  double low = 0, high = 0;        // box [N s]
  double radius = 0;               // friction_disc [m]
  int of = -1;                     // friction_disc: index of its contact

  // compliant: p_n = h k (d + h s)(1 + c s) if both factors are positive, s = -u_n (Hunt, Crossley
  //            1975);   p_t = -h (k_t (a + h u_t) + b_t u_t), limited to |p_t| <= mu p_n.
  double h = 0, k = 0, c = 0, depth = 0;
  double k_t = 0, b_t = 0;
  std::array<double, 2> anchor{};  // a: bristle deflection at the start [m]
};

class ImpulseProblem {
 public:
  void clear();
  // Adds an n x n block of M and returns its index. The caller fills M(tree) and v0(tree). The
  // blocks are allocated at the first call of M(): not for a problem without constraints.
  int add_tree(int n);
  // Adds a constraint between two trees (or ImpulseConstraint::no_tree) with zero J blocks.
  ImpulseConstraint& add(ConstraintType law, int rows, int tree_a, int tree_b);

  int tree_count() const { return static_cast<int>(size_.size()); }
  int size(int tree) const { return size_[tree]; }
  std::size_t first(int tree) const { return first_[tree]; }  // first index in v
  double* M(int tree) {                                       // symmetric, both triangles
    M_.resize(blocks_size_, 0.0);
    return M_.data() + block_[tree];
  }
  const double* M(int tree) const { return M_.data() + block_[tree]; }
  double* v0(int tree) { return v0_.data() + first_[tree]; }
  const double* v0(int tree) const { return v0_.data() + first_[tree]; }
  double* v(int tree) { return v_.data() + first_[tree]; }  // the solution
  const double* v(int tree) const { return v_.data() + first_[tree]; }
  // Of constraint c, side 0 or 1: rows x size(tree), row-major.
  double* J(const ImpulseConstraint& c, int side) { return J_.data() + c.J[side]; }
  const double* J(const ImpulseConstraint& c, int side) const { return J_.data() + c.J[side]; }
  std::size_t jacobian_size() const { return J_.size(); }
  std::vector<ImpulseConstraint>& constraints() { return constraints_; }
  const std::vector<ImpulseConstraint>& constraints() const { return constraints_; }
  std::size_t block(int tree) const { return block_[tree]; }  // index of M(tree)
  std::size_t blocks_size() const { return blocks_size_; }
  std::size_t nv() const { return v0_.size(); }

  // u = J v (without b); 0 for rows beyond c.rows.
  void velocity(const ImpulseConstraint& c, const double* v, std::array<double, 3>& u) const;
  // f += J^T p
  void add_transpose(const ImpulseConstraint& c, const std::array<double, 3>& p, double* f) const;

 private:
  std::vector<int> size_;
  std::vector<std::size_t> first_, block_;
  std::size_t blocks_size_ = 0;
  std::vector<double> M_, v0_, v_, J_;
  std::vector<ImpulseConstraint> constraints_;
};

}  // namespace twinarm
