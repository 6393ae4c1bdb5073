#include "solver/stepping/constrained_step.h"

#include <algorithm>
#include <cmath>

#include "solver/dynamics/dynamics.h"
#include "solver/integration/explicit_integrators.h"
#include "solver/model/configuration.h"

namespace twinarm {
namespace {

// A jump of velocities that sources are asked about, as a way within the step [m, rad]: what moves
// less, on arms of less than 4 m, stays within their least reach.
constexpr double jump = 1.25e-4;
constexpr int most_looks = 4;

}  // namespace

ConstrainedStep::ConstrainedStep(const Model<double>& model)
    : model_(&model),
      trees_(model),
      coulomb_(model.nv),
      constraint_(model.nv),
      shift_(model.nv),
      turning_(model.parent.size()),
      friction_guess_(model.nv),
      mimic_guess_(model.mimics.size()) {}

void ConstrainedStep::step(Mechanism& m, double h, StepReport& report) {
  start_report();
  begin_sources(m, h);
  m.begin_step(h);
  resolve_impacts(m, h, Phase::impact);
  accelerate(m, h);
  correct_rotation(m, h);
  resolve_step(m, h);
  before_ = m.x.qd;
  kick(m, h);
  move(m, h);
  separate(m, h);
  report.converged = report_.step.converged && report_.impact.converged;
  report.rounds = report_.step.rounds;
  report.iterations = report_.step.newton;
}

void ConstrainedStep::begin_sources(const Mechanism& m, double h) {
  for (ConstraintSource* source : sources_) source->begin_step(m.k, m.x, h);
}

bool ConstrainedStep::hit(Mechanism& m) {
  return resolve_impacts(m, 0, Phase::hit) > 0;
}

void ConstrainedStep::flow(Mechanism& m, double h) {
  accelerate(m, h);
  if (solve_step(m, h, Phase::flow))
    trees_.scatter(problem_, m.x.qd);
  else
    kick(m, h);
}

void ConstrainedStep::add_sources(const ConstraintFrame& frame) {
  first_.clear();
  for (ConstraintSource* source : sources_) {
    first_.push_back(problem_.constraints().size());
    source->add(frame, problem_);
  }
}

// v0 of the problem, before anything is added to it.
void ConstrainedStep::keep_velocities(ConstraintFrame& frame) {
  if (problem_.nv() == 0) return;
  velocity_.assign(problem_.v0(0), problem_.v0(0) + problem_.nv());
  frame.v = velocity_.data();
}

void ConstrainedStep::hand_out(const ConstraintFrame& frame) {
  for (std::size_t s = 0; s < sources_.size(); ++s) sources_[s]->take(frame, problem_, first_[s]);
}

// Without constraints. Dampers of joints act at the end of the step: h b is armature.
void ConstrainedStep::accelerate(Mechanism& m, double h) {
  m.forces.clear();
  for (ForceSource* source : m.sources) source->add_forces(m.x, m.k, m.forces);
  for (std::size_t dof = 0; friction_on_ && dof < model_->nv; ++dof) {
    if (model_->damping[dof] == 0) continue;
    m.forces.tau[dof] -= model_->damping[dof] * m.x.qd[dof];
    m.forces.armature[dof] += h * model_->damping[dof];
  }
  aba(*model_, m.x, m.forces, m.w);
  if (!m.has_loops()) return;
  m.dynamics.bilateral().loops().evaluate(m.x, m.k);
  m.dynamics.bilateral().prepare(m.w);
  m.start_projection();
}

// The velocities at the end of the step, in problem_, and the constraints' forces; false where
// there are none.
bool ConstrainedStep::solve_step(Mechanism& m, double h, Phase phase) {
  ConstraintFrame frame{m.k, trees_, m.x, phase, h};
  std::size_t friction = 0;
  std::fill(constraint_.begin(), constraint_.end(), 0);
  std::fill(coulomb_.begin(), coulomb_.end(), 0);
  for (int looks = 0;; ++looks) {
    problem_.clear();
    trees_.add_to(problem_, &m.forces, m.w);
    trees_.gather(m.x.qd, problem_);
    keep_velocities(frame);
    for (std::size_t dof = 0; dof < model_->nv; ++dof)
      problem_.v0(trees_.tree_of_dof(dof))[trees_.place(dof)] += h * m.w.qdd[dof];
    add_sources(frame);
    friction = problem_.constraints().size();
    add_joint_friction(m, h);
    add_bilateral(m, frame.phase, h);
    if (problem_.constraints().empty()) return false;
    report_.step = solver_.solve(problem_);
    if (phase != Phase::step || looks == most_looks || !looks_farther(m, h)) break;
  }
  hand_out(frame);
  count_bilateral(m, phase);

  sum_.assign(problem_.nv(), 0);
  for (const ImpulseConstraint& c : problem_.constraints())
    problem_.add_transpose(c, c.p, sum_.data());
  for (std::size_t dof = 0; dof < model_->nv; ++dof) {
    const int tree = trees_.tree_of_dof(dof);
    constraint_[dof] = sum_[problem_.first(tree) + trees_.place(dof)] / h;
    m.forces.tau[dof] += constraint_[dof];
  }
  std::size_t next = friction;
  for (std::size_t dof = 0; friction_on_ && dof < model_->nv; ++dof)
    if (model_->coulomb_plus[dof] > 0 || model_->coulomb_minus[dof] > 0) {
      friction_guess_[dof] = problem_.constraints()[next++].p[0];
      coulomb_[dof] = friction_guess_[dof] / h;
      constraint_[dof] -= coulomb_[dof];
    }
  for (std::size_t i = 0; i < mimic_guess_.size(); ++i)
    mimic_guess_[i] = problem_.constraints()[next++].p[0];
  for (std::size_t row = 0; row < loop_guess_.size(); ++next)
    for (int r = 0; r < problem_.constraints()[next].rows; ++r)
      loop_guess_[row++] = problem_.constraints()[next].p[static_cast<std::size_t>(r)];
  return true;
}

// With the velocities that the problem holds.
bool ConstrainedStep::looks_farther(Mechanism& m, double h) {
  double farthest = 0;
  for (int t = 0; t < problem_.tree_count(); ++t) {
    double sum = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(problem_.size(t)); ++k)
      sum += std::abs(problem_.v(t)[k] - velocity_[problem_.first(t) + k]);
    farthest = std::max(farthest, h * sum);
  }
  if (!(farthest > jump)) return false;
  m.stage = m.x;
  trees_.scatter(problem_, m.stage.qd);
  forward_kinematics(*model_, m.stage, m.k_stage);
  bool found = false;
  for (ConstraintSource* source : sources_) found = source->look_farther(m.k_stage, h) || found;
  return found;
}

void ConstrainedStep::resolve_step(Mechanism& m, double h) {
  if (!solve_step(m, h, Phase::step)) return;
  aba(*model_, m.x, m.forces, m.w);
}

void ConstrainedStep::add_joint_friction(const Mechanism&, double h) {
  for (std::size_t dof = 0; friction_on_ && dof < model_->nv; ++dof) {
    const double plus = model_->coulomb_plus[dof], minus = model_->coulomb_minus[dof];
    if (plus <= 0 && minus <= 0) continue;
    ImpulseConstraint& c =
        problem_.add(ImpulseLaw::within, 1, trees_.tree_of_dof(dof), ImpulseConstraint::no_tree);
    problem_.J(c, 0)[trees_.place(dof)] = 1;
    c.low = -h * plus, c.high = h * minus;
    c.p[0] = std::clamp(friction_guess_[dof], c.low, c.high);
  }
}

// A free body that nothing but gravity acts on moves by the mean of its velocities: so its fall and
// its energy are exact, and a bouncing ball keeps its height.
void ConstrainedStep::move(Mechanism& m, double h) {
  for (std::size_t dof = 0; dof < model_->nv; ++dof) shift_[dof] = h * m.x.qd[dof];
  flies_.assign(static_cast<std::size_t>(trees_.count()), 1);
  for (const ImpulseConstraint& c : problem_.constraints())
    if (c.p != std::array<double, 3>{})
      for (const int tree : c.tree)
        if (tree != ImpulseConstraint::no_tree) flies_[static_cast<std::size_t>(tree)] = 0;
  for (std::size_t i = 1; i < model_->parent.size(); ++i) {
    const int tree = trees_.tree_of(static_cast<int>(i));
    if (model_->joint[i] != JointType::free || tree == ImpulseConstraint::no_tree ||
        problem_.size(tree) != 6 || !flies_[static_cast<std::size_t>(tree)])
      continue;
    const Vec3<double> couple = m.forces.f_ext[i].n - turning_[i], force = m.forces.f_ext[i].f;
    bool pushed = dot(couple, couple) + dot(force, force) > 0 || m.forces.has_impedance;
    for (std::size_t dof = model_->iv[i]; dof < model_->iv[i] + 6; ++dof)
      pushed = pushed || m.forces.tau[dof] != 0 || m.forces.armature[dof] != 0;
    for (std::size_t dof = model_->iv[i]; !pushed && dof < model_->iv[i] + 6; ++dof)
      shift_[dof] = 0.5 * h * (before_[dof] + m.x.qd[dof]);
  }
  integrate_coordinates(*model_, m.x.q, shift_, m.x.q);
}

void ConstrainedStep::separate(Mechanism& m, double h) {
  bool wanted = false;
  for (const ConstraintSource* source : sources_) wanted = source->wants_separation() || wanted;
  if (!wanted) return;
  if (m.account) penetrating_ = m.x;
  problem_.clear();
  trees_.add_to(problem_, nullptr, m.w);
  const ConstraintFrame frame{m.k, trees_, m.x, Phase::separate, h};
  add_sources(frame);
  add_bilateral(m, frame.phase);
  solver_.solve(problem_);
  trees_.scatter(problem_, shift_);
  integrate_coordinates(*model_, m.x.q, shift_, m.x.q);
  if (m.account) m.account->add_separation(penetrating_, m.x);
}

}  // namespace twinarm
