#include "solver/constrained_step.h"

#include <algorithm>
#include <cmath>

#include "solver/dynamics.h"
#include "solver/integrator_explicit.h"

namespace twinarm {
namespace {

// Of many passes the worst is told: one that is not solved must not hide behind the next.
void note(const ImpulseReport& pass, bool first, ImpulseReport& worst) {
  const bool converged = pass.converged && (first || worst.converged);
  if (first || pass.residual > worst.residual) worst = pass;
  worst.converged = converged;
}

}  // namespace

ConstrainedStep::ConstrainedStep(const Model<double>& model)
    : model_(&model),
      trees_(model),
      damping_(model.nv),
      coulomb_(model.nv),
      constraint_(model.nv),
      shift_(model.nv),
      friction_guess_(model.nv),
      mimic_guess_(model.mimics.size()) {}

void ConstrainedStep::step(Mechanism& m, double h, StepReport& report) {
  start_report();
  begin_sources(m, h);
  m.begin_step(h);
  resolve_impacts(m, h, Phase::impact);
  accelerate(m, h);
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

// 1/2 v^T M v
double ConstrainedStep::kinetic_energy(const double* v) const {
  double twice = 0;
  for (int t = 0; t < problem_.tree_count(); ++t) {
    const int n = problem_.size(t);
    const double *M = problem_.M(t), *v_t = v + problem_.first(t);
    for (int r = 0; r < n; ++r)
      for (int k = 0; k < n; ++k) twice += v_t[r] * M[r * n + k] * v_t[k];
  }
  return 0.5 * twice;
}

int ConstrainedStep::resolve_impacts(Mechanism& m, double h, Phase phase) {
  int passes = 0;
  for (; passes < most_impacts; ++passes, ++report_.impacts) {
    ConstraintFrame frame{m.k, trees_, m.x, phase, h};
    bool closes = false;
    for (ConstraintSource* source : sources_) closes = source->closes(frame) || closes;
    if (!closes) break;
    if (passes == 0) {
      accelerate(m, h);
      acceleration_ = m.w.qdd;
    }
    const auto solve = [&](bool plastic) {
      frame.plastic = plastic;
      problem_.clear();
      trees_.add_to(problem_, nullptr, m.w);
      trees_.gather(acceleration_, problem_);
      sum_.assign(problem_.v0(0), problem_.v0(0) + problem_.nv());
      frame.acceleration = sum_.data();
      trees_.gather(m.x.qd, problem_);
      keep_velocities(frame);
      add_sources(frame);
      add_bilateral(m, frame.phase);
      return solver_.solve(problem_);
    };
    ImpulseReport pass = solve(false);
    const double before = kinetic_energy(problem_.v0(0));
    double after = kinetic_energy(problem_.v(0));
    if (after > before) {
      elastic_.assign(problem_.v(0), problem_.v(0) + problem_.nv());
      elastic_p_.clear();
      for (const ImpulseConstraint& c : problem_.constraints())
        elastic_p_.insert(elastic_p_.end(), c.p.begin(), c.p.end());
      pass = solve(true);
      after = bounce();
    }
    note(pass, report_.impacts == 0, report_.impact);
    report_.impact_loss += before - after;
    hand_out(frame);  // with the kinematics before
    count_bilateral(m, phase);
    trees_.scatter(problem_, m.x.qd);
    forward_kinematics(*model_, m.x, m.k);
  }
  return passes;
}

// From the plastic solution, which the problem holds, towards the elastic one (elastic_ its
// velocities, elastic_p_ its impulses) as far as the energy before allows. Impulses of both lie in
// convex cones, so the mixture does. Returns the energy after.
double ConstrainedStep::bounce() {
  double* v = problem_.v(0);
  const std::size_t nv = problem_.nv();
  const double before = kinetic_energy(problem_.v0(0)), plastic = kinetic_energy(v);
  for (std::size_t k = 0; k < nv; ++k) elastic_[k] -= v[k];
  const double square = kinetic_energy(elastic_.data());
  double cross = 0;  // d/ds of the energy at s = 0
  for (int t = 0; t < problem_.tree_count(); ++t) {
    const int n = problem_.size(t);
    const double *M = problem_.M(t), *a = problem_.v(t), *b = elastic_.data() + problem_.first(t);
    for (int r = 0; r < n; ++r)
      for (int k = 0; k < n; ++k) cross += a[r] * M[r * n + k] * b[k];
  }
  // square s^2 + cross s + plastic = before
  const double room = std::max(0.0, before - plastic);
  const double root = std::sqrt(cross * cross + 4 * square * room);
  const double s = std::clamp(2 * room / (cross + root), 0.0, 1.0);
  for (std::size_t k = 0; k < nv; ++k) v[k] += s * elastic_[k];
  for (std::size_t i = 0; i < problem_.constraints().size(); ++i)
    for (std::size_t r = 0; r < 3; ++r) {
      double& p = problem_.constraints()[i].p[r];
      p += s * (elastic_p_[3 * i + r] - p);
    }
  return kinetic_energy(v);
}

// Without constraints. Dampers of joints act at the end of the step: h b is armature.
void ConstrainedStep::accelerate(Mechanism& m, double h) {
  m.forces.clear();
  for (ForceSource* source : m.sources) source->add_forces(m.x, m.k, m.forces);
  for (std::size_t dof = 0; dof < model_->nv; ++dof) {
    damping_[dof] = friction_on_ ? -model_->damping[dof] * m.x.qd[dof] : 0;
    if (damping_[dof] == 0 && model_->damping[dof] == 0) continue;
    m.forces.tau[dof] += damping_[dof];
    if (friction_on_) m.forces.armature[dof] += h * model_->damping[dof];
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
  problem_.clear();
  trees_.add_to(problem_, &m.forces, m.w);
  trees_.gather(m.x.qd, problem_);
  ConstraintFrame frame{m.k, trees_, m.x, phase, h};
  keep_velocities(frame);
  for (std::size_t dof = 0; dof < model_->nv; ++dof)
    problem_.v0(trees_.tree_of_dof(dof))[trees_.place(dof)] += h * m.w.qdd[dof];
  add_sources(frame);
  const std::size_t friction = problem_.constraints().size();
  add_joint_friction(m, h);
  add_bilateral(m, frame.phase, h);
  std::fill(constraint_.begin(), constraint_.end(), 0);
  std::fill(coulomb_.begin(), coulomb_.end(), 0);
  if (problem_.constraints().empty()) return false;
  report_.step = solver_.solve(problem_);
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

void ConstrainedStep::resolve_step(Mechanism& m, double h) {
  if (!solve_step(m, h, Phase::step)) return;
  aba(*model_, m.x, m.forces, m.w);
  if (friction_on_)
    for (std::size_t dof = 0; dof < model_->nv; ++dof)
      damping_[dof] -= h * model_->damping[dof] * m.w.qdd[dof];
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

void ConstrainedStep::add_mimics() {
  for (std::size_t i = 0; i < model_->mimics.size(); ++i) {
    const Mimic& mimic = model_->mimics[i];
    const int a = trees_.tree_of_dof(mimic.follower), b = trees_.tree_of_dof(mimic.leader);
    ImpulseConstraint& c =
        problem_.add(ImpulseLaw::equal, 1, a, a == b ? ImpulseConstraint::no_tree : b);
    problem_.J(c, 0)[trees_.place(mimic.follower)] = 1;
    problem_.J(c, a == b ? 0 : 1)[trees_.place(mimic.leader)] -= mimic.ratio;
    c.p[0] = mimic_guess_[i];
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
    const Force<double>& f = m.forces.f_ext[i];
    bool pushed = dot(f.n, f.n) + dot(f.f, f.f) > 0 || m.forces.has_impedance;
    for (std::size_t dof = model_->iv[i]; dof < model_->iv[i] + 6; ++dof)
      pushed = pushed || m.forces.tau[dof] != 0 || m.forces.armature[dof] != 0;
    for (std::size_t dof = model_->iv[i]; !pushed && dof < model_->iv[i] + 6; ++dof)
      shift_[dof] = 0.5 * h * (before_[dof] + m.x.qd[dof]);
  }
  integrate_coordinates(*model_, m.x.q, shift_, m.x.q);
}

void ConstrainedStep::add_bilateral(Mechanism& m, Phase phase, double h) {
  first_bilateral_ = problem_.constraints().size();
  add_mimics();
  if (m.has_loops()) add_loops(m, phase, h);
}

// Works and momenta of what add_bilateral() added (step_account.h).
void ConstrainedStep::count_bilateral(Mechanism& m, Phase phase) {
  if (!m.account) return;
  const bool in_flow = phase == Phase::flow;
  const auto work_of = [&](const ImpulseConstraint& c) {
    std::array<double, 3> before, after;
    problem_.velocity(c, velocity_.data(), before);
    problem_.velocity(c, problem_.v(0), after);
    double work = 0;
    for (std::size_t r = 0; r < 3; ++r) work += 0.5 * c.p[r] * (before[r] + after[r]);
    return work;
  };
  std::size_t next = first_bilateral_;
  for (std::size_t i = 0; i < model_->mimics.size(); ++i)
    m.account->add_mimic(i, work_of(problem_.constraints()[next++]), in_flow);
  const LoopClosures& loops = m.dynamics.bilateral().loops();
  lambda_.resize(static_cast<Eigen::Index>(loops.rows()));
  for (std::size_t row = 0; row < loops.rows(); ++next) {
    const ImpulseConstraint& c = problem_.constraints()[next];
    Exchange on_both;
    on_both.work = work_of(c);
    m.account->add_loop(loops.loop_of(row), on_both, in_flow);
    for (int r = 0; r < c.rows; ++r)
      lambda_[static_cast<Eigen::Index>(row++)] = c.p[static_cast<std::size_t>(r)];
  }
  for (std::size_t l = 0; l < loops.loops().size(); ++l) {
    Exchange on_a;
    const LoopWrench wrench = loops.wrench(l, lambda_);
    on_a.add_wrench(1, loops.point(l), wrench.force, wrench.couple);
    m.account->add_loop(l, on_a, in_flow);
  }
}

// g' = 0; what is left of g = 0 is for Mechanism::refresh().
void ConstrainedStep::add_loops(Mechanism& m, Phase phase, double h) {
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
      const int tree = trees_.tree_of_dof(dof);
      if (a == ImpulseConstraint::no_tree) a = tree;
      if (tree != a) b = tree;
    }
    ImpulseConstraint& c = problem_.add(ImpulseLaw::equal, static_cast<int>(count), a, b);
    for (std::size_t r = 0; r < count; ++r) {
      const auto from = static_cast<Eigen::Index>(row + r);
      c.b[r] = phase == Phase::separate ? 0 : loops.rate()[from];
      if (with_gamma_ && phase == Phase::step) c.b[r] += h * loops.gamma()[from];
      if (phase == Phase::step || phase == Phase::flow) c.p[r] = loop_guess_[row + r];
      for (const std::size_t dof : dofs) {
        const double entry = loops.J()(from, static_cast<Eigen::Index>(dof));
        const int tree = trees_.tree_of_dof(dof);
        const std::size_t n = static_cast<std::size_t>(problem_.size(tree));
        problem_.J(c, tree == a ? 0 : 1)[r * n + trees_.place(dof)] = entry;
        // what prescribed joints do is in g' and not in J qd
        if (phase != Phase::separate) c.b[r] -= entry * m.x.qd[dof];
      }
    }
  }
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
