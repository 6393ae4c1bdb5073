// A mechanism as a set of trees that only the base joins: the blocks of its mass matrix.
//
// Constraints couple trees, inertia does not. So velocities are sorted by tree here ("places"), and
// each tree has a dense block of M. A free body is a tree of its own.
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
  // Of the body; ImpulseConstraint::no_tree for the base and what hangs on it by fixed joints.
  int tree_of(int body) const { return tree_[static_cast<std::size_t>(body)]; }
  int tree_of_dof(std::size_t dof) const { return tree_of_dof_[dof]; }
  std::size_t place(std::size_t dof) const { return place_[dof]; }  // of a velocity in its tree

  // The trees of the problem, with M of the configuration that w.Xup and w.S_ belong to: inertia,
  // armature, and the implicit terms of `forces` where given (those that aba() solved with).
  void add_to(ImpulseProblem& problem, const Forces<double>* forces, Workspace<double>& w);
  // Between the velocities of the model and those of the problem.
  void gather(const std::vector<double>& qd, ImpulseProblem& problem) const;   // to v0
  void scatter(const ImpulseProblem& problem, std::vector<double>& qd) const;  // from v

  // Adds `sign` times the velocity along each of `axes` (columns, world axes) of the body's point
  // now at p_W to the rows from `row` on, of that side of the constraint.
  void add_point_rows(const Kinematics& k, int body, const Vector3& p_W, const Matrix3& axes,
                      int count, double sign, double* J) const;
  // The same for the body's angular velocity.
  void add_turn_rows(const Kinematics& k, int body, const Matrix3& axes, int count, double sign,
                     double* J) const;

 private:
  const Model<double>* model_;
  std::vector<int> tree_, tree_of_dof_, size_;
  std::vector<std::size_t> place_;
  std::vector<ArticulatedInertia<double>> Ic_;  // composite, with the implicit terms
};

}  // namespace twinarm
