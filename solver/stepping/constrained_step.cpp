#include "solver/stepping/constrained_step.h"

#include <algorithm>
#include <cmath>

#include "solver/dynamics/dynamics.h"
#include "solver/integration/explicit_integrators.h"
#include "solver/model/configuration.h"

namespace twinarm {
namespace {

// Displacement in the step due to a velocity jump [m, rad] above which contact detection is
// extended; smaller ones, on lever arms below 4 m, stay within the sources' minimum margin.
constexpr double kDetectionJump = 1.25e-4;
constexpr int kMaxDetections = 4;

}  // namespace

ConstrainedStep::ConstrainedStep(const Model<double>& model)
    : model_(&model), system_(model), couples_(model), constraint_(model.nv), delta_(model.nv) {}

void ConstrainedStep::step(IntegrationState& m, double h, StepReport& report) {
  start_report();
  system_.begin_step(m, h);
  m.begin_step(h);
  impacts_.resolve(system_, m, h, Phase::impact, report_);
  system_.accelerate(m, h);
  if (!at_instant_) couples_.apply(m, h);
  const bool constrained = solve_step(m, h, Phase::step);
  if (constrained) aba(*model_, m.x, m.forces, m.w);
  before_ = m.x.qd;
  kick(m, h);
  if (sleep_.is_on()) fall_asleep(m, h, constrained);
  update_positions(m, h);
  correct_positions(m, h);
  report.converged = report_.step.converged && report_.impact.converged;
  report.iterations = report_.step.newton;
}

void ConstrainedStep::smooth_step(IntegrationState& m, double h) {
  system_.accelerate(m, h);
  if (solve_step(m, h, Phase::smooth))
    system_.trees.scatter(system_.problem, m.x.qd);
  else
    kick(m, h);
}

void ConstrainedStep::serialize(StateArchive& archive, std::size_t loop_rows) {
  system_.friction.serialize(archive);
  system_.bilateral.serialize(archive, loop_rows);
  system_.solver.serialize(archive);
  sleep_.serialize(archive);
}

// Solves for the velocities at the end of the step and the constraint forces; false if there are no
// constraints.
bool ConstrainedStep::solve_step(IntegrationState& m, double h, Phase phase) {
  ImpulseProblem& problem = system_.problem;
  const KinematicTrees& trees = system_.trees;
  ConstraintFrame frame{m.k, trees, m.x, phase, h};
  std::fill(constraint_.begin(), constraint_.end(), 0);
  system_.friction.clear();
  for (int detections = 0;; ++detections) {
    system_.begin_problem();
    trees.gather(m.x.qd, problem);
    system_.store_velocities(frame);
    for (std::size_t dof = 0; dof < model_->nv; ++dof)
      problem.v0(trees.tree_of_dof(dof))[trees.index_in_tree(dof)] += h * m.w.qdd[dof];
    system_.add_sources(frame);
    system_.friction.add_to(problem, trees, h);
    system_.bilateral.add_to(problem, trees, m, phase, h);
    if (problem.constraints().empty()) return false;
    system_.trees.set_mass_matrix(problem, &m.forces, m.w);
    report_.step = system_.solver.solve(problem);
    if (phase != Phase::step || detections == kMaxDetections || !extend_detection(m, h)) break;
  }
  system_.distribute_impulses(frame);
  system_.bilateral.add_work(problem, system_.velocity.data(), m, phase);
  system_.friction.read_impulses(problem, h);
  system_.bilateral.keep_guesses(problem);

  sum_.assign(problem.nv(), 0);
  for (const ImpulseConstraint& c : problem.constraints())
    problem.add_transpose(c, c.p, sum_.data());
  for (std::size_t dof = 0; dof < model_->nv; ++dof) {
    const double force = sum_[problem.first(trees.tree_of_dof(dof)) + trees.index_in_tree(dof)] / h;
    m.forces.tau[dof] += force;
    constraint_[dof] = force - coulomb_torque()[dof];
  }
  return true;
}

// Contact detection at the velocities of the solution; true if it finds new constraints.
bool ConstrainedStep::extend_detection(IntegrationState& m, double h) {
  const ImpulseProblem& problem = system_.problem;
  double max_displacement = 0;
  for (int t = 0; t < problem.tree_count(); ++t) {
    double sum = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(problem.size(t)); ++k)
      sum += std::abs(problem.v(t)[k] - system_.velocity[problem.first(t) + k]);
    max_displacement = std::max(max_displacement, h * sum);
  }
  if (!(max_displacement > kDetectionJump)) return false;
  m.stage = m.x;
  system_.trees.scatter(problem, m.stage.qd);
  forward_kinematics(*model_, m.stage, m.k_stage);
  bool found = false;
  for (ConstraintSource* source : system_.sources)
    found = source->extend_detection(m.k_stage, h) || found;
  return found;
}

void ConstrainedStep::fall_asleep(IntegrationState& m, double h, bool constrained) {
  using Islands = std::span<const ImpulseIsland::Members>;
  sleep_.update({system_.problem, constrained ? system_.solver.islands() : Islands(),
                 system_.velocity, system_.solver.accuracy.accepted, h});
  if (m.account) before_change_ = m.x;
  for (std::size_t dof = 0; dof < model_->nv; ++dof)
    if (sleep_.is_asleep(system_.trees.tree_of_dof(dof))) m.x.qd[dof] = 0;
  if (m.account) m.account->add_sleep(before_change_, m.x);
}

int ConstrainedStep::bodies_asleep() const {
  int count = 0;
  for (int body = 1; body < model_->body_count(); ++body) {
    const int tree = system_.trees.tree_of(body);
    count += tree != ImpulseConstraint::no_tree && sleep_.is_asleep(tree);
  }
  return count;
}

// q' = q exp(h v'). Free bodies under gravity alone use the mean of v and v': exact free fall and
// energy, so that a bouncing ball keeps its height.
void ConstrainedStep::update_positions(IntegrationState& m, double h) {
  for (std::size_t dof = 0; dof < model_->nv; ++dof) delta_[dof] = h * m.x.qd[dof];
  is_free_.assign(static_cast<std::size_t>(system_.trees.count()), 1);
  for (const ImpulseConstraint& c : system_.problem.constraints())
    if (c.p != std::array<double, 3>{})
      for (const int tree : c.tree)
        if (tree != ImpulseConstraint::no_tree) is_free_[static_cast<std::size_t>(tree)] = 0;
  for (std::size_t i = 1; i < model_->parent.size(); ++i) {
    const int tree = system_.trees.tree_of(static_cast<int>(i));
    if (model_->joint[i] != JointType::free || tree == ImpulseConstraint::no_tree ||
        system_.problem.size(tree) != 6 || !is_free_[static_cast<std::size_t>(tree)])
      continue;
    const Vec3<double> couple = m.forces.f_ext[i].n - couples_.of(i), force = m.forces.f_ext[i].f;
    bool forced = dot(couple, couple) + dot(force, force) > 0 || m.forces.has_added_inertia;
    for (std::size_t dof = model_->iv[i]; dof < model_->iv[i] + 6; ++dof)
      forced = forced || m.forces.tau[dof] != 0 || m.forces.armature[dof] != 0;
    for (std::size_t dof = model_->iv[i]; !forced && dof < model_->iv[i] + 6; ++dof)
      delta_[dof] = 0.5 * h * (before_[dof] + m.x.qd[dof]);
  }
  integrate_coordinates(*model_, m.x.q, delta_, m.x.q);
}

void ConstrainedStep::correct_positions(IntegrationState& m, double h) {
  const auto needed = [](const ConstraintSource* s) { return s->needs_position_correction(); };
  if (std::none_of(system_.sources.begin(), system_.sources.end(), needed)) return;
  if (m.account) before_change_ = m.x;
  system_.begin_problem();
  system_.add_sources({m.k, system_.trees, m.x, Phase::position_correction, h});
  system_.bilateral.add_to(system_.problem, system_.trees, m, Phase::position_correction);
  system_.trees.set_mass_matrix(system_.problem, nullptr, m.w);
  system_.solver.solve(system_.problem, /*full=*/false);
  system_.trees.scatter(system_.problem, delta_);
  integrate_coordinates(*model_, m.x.q, delta_, m.x.q);
  if (m.account) m.account->add_separation(before_change_, m.x);
}

}  // namespace twinarm
