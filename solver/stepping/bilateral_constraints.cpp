#include "solver/stepping/bilateral_constraints.h"

#include <stdexcept>
#include <string>

namespace twinarm {

void BilateralConstraints::serialize(StateArchive& archive, std::size_t loop_rows) {
  archive.visit_fixed(mimic_guess_);
  archive.visit(loop_guess_);
  if (!loop_guess_.empty() && loop_guess_.size() != loop_rows)
    throw std::runtime_error("state data has " + std::to_string(loop_guess_.size()) +
                             " loop rows, this simulation " + std::to_string(loop_rows));
}

void BilateralConstraints::add_to(ImpulseProblem& problem, const KinematicTrees& trees,
                                  IntegrationState& m, Phase phase, double h) {
  first_ = problem.constraints().size();
  add_mimics(problem, trees);
  if (m.has_loops()) add_loops(problem, trees, m, phase, h);
}

void BilateralConstraints::add_mimics(ImpulseProblem& problem, const KinematicTrees& trees) {
  for (std::size_t i = 0; i < model_->mimics.size(); ++i) {
    const Mimic& mimic = model_->mimics[i];
    const int a = trees.tree_of_dof(mimic.follower), b = trees.tree_of_dof(mimic.leader);
    ImpulseConstraint& c =
        problem.add(ConstraintType::bilateral, 1, a, a == b ? ImpulseConstraint::no_tree : b);
    problem.J(c, 0)[trees.index_in_tree(mimic.follower)] = 1;
    problem.J(c, a == b ? 0 : 1)[trees.index_in_tree(mimic.leader)] -= mimic.ratio;
    c.p[0] = mimic_guess_[i];
  }
}

void BilateralConstraints::keep_guesses(const ImpulseProblem& problem) {
  std::size_t next = first_;
  for (double& guess : mimic_guess_) guess = problem.constraints()[next++].p[0];
  for (std::size_t row = 0; row < loop_guess_.size(); ++next)
    for (int r = 0; r < problem.constraints()[next].rows; ++r)
      loop_guess_[row++] = problem.constraints()[next].p[static_cast<std::size_t>(r)];
}

void BilateralConstraints::add_work(const ImpulseProblem& problem, const double* velocity_before,
                                    IntegrationState& m, Phase phase) {
  if (!m.account) return;
  const bool in_segment = phase == Phase::smooth;
  const auto work_of = [&](const ImpulseConstraint& c) {
    std::array<double, 3> before, after;
    problem.velocity(c, velocity_before, before);
    problem.velocity(c, problem.v(0), after);
    double work = 0;
    for (std::size_t r = 0; r < 3; ++r) work += 0.5 * c.p[r] * (before[r] + after[r]);
    return work;
  };
  std::size_t next = first_;
  for (std::size_t i = 0; i < model_->mimics.size(); ++i)
    m.account->add_mimic(i, work_of(problem.constraints()[next++]), in_segment);
  const LoopClosures& loops = m.dynamics.bilateral().loops();
  lambda_.resize(static_cast<Eigen::Index>(loops.rows()));
  for (std::size_t row = 0; row < loops.rows(); ++next) {
    const ImpulseConstraint& c = problem.constraints()[next];
    EnergyMomentum on_both;
    on_both.work = work_of(c);
    m.account->add_loop(loops.loop_of(row), on_both, in_segment);
    for (int r = 0; r < c.rows; ++r)
      lambda_[static_cast<Eigen::Index>(row++)] = c.p[static_cast<std::size_t>(r)];
  }
  for (std::size_t l = 0; l < loops.loops().size(); ++l) {
    EnergyMomentum on_a;
    const LoopWrench wrench = loops.wrench(l, lambda_);
    on_a.add_wrench(1, loops.point(l), wrench.force, wrench.couple);
    m.account->add_loop(l, on_a, in_segment);
  }
}

// g' = 0; g = 0 is restored by IntegrationState::project_and_update().
void BilateralConstraints::add_loops(ImpulseProblem& problem, const KinematicTrees& trees,
                                     IntegrationState& m, Phase phase, double h) {
  LoopClosures& loops = m.dynamics.bilateral().loops();
  loops.evaluate(m.x, m.k);
  loop_guess_.resize(loops.rows());
  for (std::size_t row = 0, count = 0; row < loops.rows(); row += count) {
    for (count = 1; count < 3 && row + count < loops.rows() &&
                    loops.loop_of(row + count) == loops.loop_of(row);)
      ++count;
    const std::vector<std::size_t>& dofs = loops.dofs_of(row);
    int a = ImpulseConstraint::no_tree, b = ImpulseConstraint::no_tree;
    for (const std::size_t dof : dofs) {
      const int tree = trees.tree_of_dof(dof);
      if (a == ImpulseConstraint::no_tree) a = tree;
      if (tree != a) b = tree;
    }
    ImpulseConstraint& c = problem.add(ConstraintType::bilateral, static_cast<int>(count), a, b);
    for (std::size_t r = 0; r < count; ++r) {
      const auto from = static_cast<Eigen::Index>(row + r);
      c.b[r] = phase == Phase::position_correction ? 0 : loops.rate()[from];
      if (with_gamma_ && phase == Phase::step) c.b[r] += h * loops.gamma()[from];
      if (phase == Phase::step || phase == Phase::smooth) c.p[r] = loop_guess_[row + r];
      for (const std::size_t dof : dofs) {
        const double entry = loops.J()(from, static_cast<Eigen::Index>(dof));
        const int tree = trees.tree_of_dof(dof);
        const std::size_t n = static_cast<std::size_t>(problem.size(tree));
        problem.J(c, tree == a ? 0 : 1)[r * n + trees.index_in_tree(dof)] = entry;
        // leaves the velocity of prescribed joints: g' - J qd
        if (phase != Phase::position_correction) c.b[r] -= entry * m.x.qd[dof];
      }
    }
  }
}

}  // namespace twinarm
