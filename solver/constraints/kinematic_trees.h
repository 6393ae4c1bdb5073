// Kinematic trees: subtrees of the base with at least one degree of freedom. Each has a dense block
// of the mass matrix; constraints couple them. Velocities are sorted by tree. A free body is a
// tree.
#pragma once

#include <cstddef>
#include <vector>

#include "solver/dynamics/kinematics.h"
#include "solver/impulses/impulse_problem.h"
#include "solver/model/model.h"
#include "solver/model/workspace.h"

namespace twinarm {

class KinematicTrees {
 public:
  explicit KinematicTrees(const Model<double>& model);

  int count() const { return static_cast<int>(size_.size()); }
  // ImpulseConstraint::no_tree for the base and bodies that are fixed to it.
  int tree_of(int body) const { return tree_[static_cast<std::size_t>(body)]; }
  int tree_of_dof(std::size_t dof) const { return tree_of_dof_[dof]; }
  std::size_t index_in_tree(std::size_t dof) const { return index_[dof]; }

  // Adds the trees to the problem, without M.
  void add_to(ImpulseProblem& problem) const {
    for (const int size : size_) problem.add_tree(size);
  }
  // M at the configuration of w.Xup and w.S_: inertia, armature, and the implicit terms of `forces`
  // if given. Throws InputError if the blocks have more than kMaxEntries.
  static constexpr std::size_t kMaxEntries = 4000 * 4000;
  void set_mass_matrix(ImpulseProblem& problem, const Forces<double>* forces, Workspace<double>& w);
  // qd to v0
  void gather(const std::vector<double>& qd, ImpulseProblem& problem) const {
    for (std::size_t dof = 0; dof < qd.size(); ++dof)
      problem.v0(tree_of_dof_[dof])[index_[dof]] = qd[dof];
  }
  // v to qd
  void scatter(const ImpulseProblem& problem, std::vector<double>& qd) const {
    for (std::size_t dof = 0; dof < qd.size(); ++dof)
      qd[dof] = problem.v(tree_of_dof_[dof])[index_[dof]];
  }

  // J += sign * rows of the velocity along `axes` (columns, world axes) of the body's point
  // currently at p_W; J: block of the body's tree.
  void add_point_rows(const Kinematics& k, int body, const Vector3& p_W, const Matrix3& axes,
                      int count, double sign, double* J) const;
  // The same for the angular velocity.
  void add_rotation_rows(const Kinematics& k, int body, const Matrix3& axes, int count, double sign,
                         double* J) const;

 private:
  const Model<double>* model_;
  std::vector<int> tree_, tree_of_dof_, size_;
  std::vector<std::size_t> index_;
  std::vector<ArticulatedInertia<double>> Ic_;  // composite inertias with implicit terms
};

}  // namespace twinarm
