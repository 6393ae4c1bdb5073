#include "solver/constraints/kinematic_trees.h"

#include <string>

#include "solver/support/diagnostics.h"

namespace twinarm {

KinematicTrees::KinematicTrees(const Model<double>& model)
    : model_(&model),
      tree_(model.parent.size(), ImpulseConstraint::no_tree),
      tree_of_dof_(model.nv),
      index_(model.nv),
      Ic_(model.parent.size()) {
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    tree_[i] = tree_[static_cast<std::size_t>(model.parent[i])];
    const std::size_t dofs = model.dofs(i);
    if (dofs == 0) continue;
    if (tree_[i] == ImpulseConstraint::no_tree) {
      tree_[i] = count();
      size_.push_back(0);
    }
    for (std::size_t dof = model.iv[i]; dof < model.iv[i] + dofs; ++dof) {
      tree_of_dof_[dof] = tree_[i];
      index_[dof] = static_cast<std::size_t>(size_[tree_[i]]++);
    }
  }
}

// Composite-rigid-body algorithm, RBDA section 6.2, per tree.
void KinematicTrees::set_mass_matrix(ImpulseProblem& problem, const Forces<double>* forces,
                                     Workspace<double>& w) {
  if (problem.blocks_size() > kMaxEntries)
    throw InputError(
        {{"", 0, "contacts, limits and friction",
          "act on a robot of too many joints: its mass matrix has more than " +
              std::to_string(kMaxEntries) + " entries",
          "give fewer links, or joints without limits and friction, and collide = false",
          "model.too-large"}});
  const Model<double>& model = *model_;
  const std::size_t n = model.parent.size();
  for (std::size_t i = 1; i < n; ++i) {
    Ic_[i] = model.I[i];
    if (forces && forces->has_added_inertia) Ic_[i] += forces->added_inertia[i];
  }
  for (std::size_t i = n; i-- > 1;) {
    if (tree_[i] == ImpulseConstraint::no_tree) continue;
    const auto parent = static_cast<std::size_t>(model.parent[i]);
    if (parent > 0) add_congruence(w.Xup[i], Ic_[i], Ic_[parent], Ic_[parent]);
    const auto size = static_cast<std::size_t>(size_[tree_[i]]);
    double* M = problem.M(tree_[i]);
    for (std::size_t dof = model.iv[i]; dof < model.iv[i] + model.dofs(i); ++dof) {
      Force<double> F = Ic_[i] * w.S_[dof];
      for (std::size_t j = i; j > 0; j = static_cast<std::size_t>(model.parent[j])) {
        for (std::size_t other = model.iv[j]; other < model.iv[j] + model.dofs(j); ++other)
          M[index_[dof] * size + index_[other]] = M[index_[other] * size + index_[dof]] =
              dot(w.S_[other], F);
        F = transpose_times(w.Xup[j], F);
      }
      double& diagonal = M[index_[dof] * (size + 1)];
      diagonal += model.armature[dof] + (forces ? forces->armature[dof] : 0);
    }
  }
}

void KinematicTrees::add_point_rows(const Kinematics& k, int body, const Vector3& p_W,
                                    const Matrix3& axes, int count, double sign, double* J) const {
  const int tree = tree_of(body);
  if (tree == ImpulseConstraint::no_tree) return;
  const auto n = static_cast<std::size_t>(size_[tree]);
  for_each_dof_below(
      *model_, k, body, [&](std::size_t dof, const Vector3& w, const Vector3& v, const Vector3& o) {
        const Vector3 at_point = v + w.cross(p_W - o);
        for (int r = 0; r < count; ++r)
          J[static_cast<std::size_t>(r) * n + index_[dof]] += sign * axes.col(r).dot(at_point);
      });
}

void KinematicTrees::add_rotation_rows(const Kinematics& k, int body, const Matrix3& axes,
                                       int count, double sign, double* J) const {
  const int tree = tree_of(body);
  if (tree == ImpulseConstraint::no_tree) return;
  const auto n = static_cast<std::size_t>(size_[tree]);
  for_each_dof_below(
      *model_, k, body, [&](std::size_t dof, const Vector3& w, const Vector3&, const Vector3&) {
        for (int r = 0; r < count; ++r)
          J[static_cast<std::size_t>(r) * n + index_[dof]] += sign * axes.col(r).dot(w);
      });
}

}  // namespace twinarm
