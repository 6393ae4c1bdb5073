// The impacts of a step under constraints (constrained_step.h).
//
// Newton's law may ask for what cannot be: a body that is wedged between two surfaces, by friction
// beyond the angle between them, cannot leave one of them without being pressed into the other.
// Then no velocities obey the law, however small the restitution, and impulses grow without bound
// where they are sought. What touches such a body is taken without restitution: that has a
// solution, since not to move obeys u >= 0, and it gains no energy.
#include <algorithm>
#include <cmath>

#include "solver/stepping/constrained_step.h"

namespace twinarm {
namespace {

constexpr double obeyed = 1e-8;  // the law, by velocities within that residual [m/s]

// Of many passes the worst is told: one that is not solved must not hide behind the next.
void note(const ImpulseReport& pass, bool first, ImpulseReport& worst) {
  const bool converged = pass.converged && (first || worst.converged);
  if (first || pass.residual > worst.residual) worst = pass;
  worst.converged = converged;
}

}  // namespace

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
    plastic_.assign(static_cast<std::size_t>(trees_.count()), 0);
    frame.plastic = &plastic_;
    const auto solve = [&] {
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
    ImpulseReport pass = solve();
    if (!(pass.residual <= obeyed)) {
      for (int t = 0; t < trees_.count(); ++t)
        plastic_[static_cast<std::size_t>(t)] = !(solver_.residual_of(t) <= obeyed);
      ++report_.wedged;
      pass = solve();
    }
    const double before = kinetic_energy(problem_.v0(0));
    double after = kinetic_energy(problem_.v(0));
    if (after > before) {
      elastic_.assign(problem_.v(0), problem_.v(0) + problem_.nv());
      elastic_p_.clear();
      for (const ImpulseConstraint& c : problem_.constraints())
        elastic_p_.insert(elastic_p_.end(), c.p.begin(), c.p.end());
      plastic_.assign(plastic_.size(), 1);
      pass = solve();
      after = bounce();
    }
    note(pass, report_.impacts == 0, report_.impact);
    report_.impact_loss += before - after;
    hand_out(frame);  // with the kinematics before
    count_bilateral(m, phase);
    trees_.scatter(problem_, m.x.qd);
    forward_kinematics(*model_, m.x, m.k);
    for (ConstraintSource* source : sources_) source->look_farther(m.k, h);
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

}  // namespace twinarm
