#include "solver/stepping/impacts.h"

#include <algorithm>
#include <cmath>

namespace twinarm {
namespace {

constexpr double kFeasible = 1e-8;  // residual of the impact law [m/s]

// Keeps the report of the pass with the largest residual; converged only if all passes are.
void keep_worst(const ImpulseReport& pass, bool first, ImpulseReport& worst) {
  const bool converged = pass.converged && (first || worst.converged);
  if (first || pass.residual > worst.residual) worst = pass;
  worst.converged = converged;
}

// a^T M b
double mass_product(const ImpulseProblem& problem, const double* a, const double* b) {
  double sum = 0;
  for (int t = 0; t < problem.tree_count(); ++t) {
    const int n = problem.size(t);
    const double *M = problem.M(t), *a_t = a + problem.first(t), *b_t = b + problem.first(t);
    for (int r = 0; r < n; ++r)
      for (int k = 0; k < n; ++k) sum += a_t[r] * M[r * n + k] * b_t[k];
  }
  return sum;
}
double kinetic_energy(const ImpulseProblem& problem, const double* v) {
  return 0.5 * mass_product(problem, v, v);
}

}  // namespace

ImpulseReport Impacts::solve(ConstraintSystem& system, IntegrationState& m,
                             ConstraintFrame& frame) {
  ImpulseProblem& problem = system.problem;
  system.begin_problem();
  system.trees.gather(acceleration_, problem);
  by_tree_.assign(problem.v0(0), problem.v0(0) + problem.nv());
  frame.acceleration = by_tree_.data();
  system.trees.gather(m.x.qd, problem);
  system.store_velocities(frame);
  system.add_sources(frame);
  system.bilateral.add_to(problem, system.trees, m, frame.phase);
  system.trees.set_mass_matrix(problem, nullptr, m.w);
  return system.solver.solve(problem);
}

int Impacts::resolve(ConstraintSystem& system, IntegrationState& m, double h, Phase phase,
                     ConstraintReport& report) {
  ImpulseProblem& problem = system.problem;
  int passes = 0;
  for (; passes < kMaxImpacts; ++passes, ++report.impacts) {
    ConstraintFrame frame{m.k, system.trees, m.x, phase, h};
    bool has_closing_contact = false;
    for (ConstraintSource* source : system.sources)
      has_closing_contact = source->has_closing_contact(frame) || has_closing_contact;
    if (!has_closing_contact) break;
    if (passes == 0) {
      system.accelerate(m, h);
      acceleration_ = m.w.qdd;
    }
    plastic_.assign(static_cast<std::size_t>(system.trees.count()), 0);
    frame.plastic = &plastic_;
    ImpulseReport pass = solve(system, m, frame);
    if (!(pass.residual <= kFeasible)) {
      for (std::size_t t = 0; t < plastic_.size(); ++t)
        plastic_[t] = !(system.solver.residual_of(static_cast<int>(t)) <= kFeasible);
      ++report.infeasible_impacts;
      pass = solve(system, m, frame);
    }
    const double before = kinetic_energy(problem, problem.v0(0));
    double after = kinetic_energy(problem, problem.v(0));
    if (after > before) {
      elastic_.assign(problem.v(0), problem.v(0) + problem.nv());
      elastic_p_.clear();
      for (const ImpulseConstraint& c : problem.constraints())
        elastic_p_.insert(elastic_p_.end(), c.p.begin(), c.p.end());
      plastic_.assign(plastic_.size(), 1);
      pass = solve(system, m, frame);
      after = blend_towards_elastic(problem);
    }
    keep_worst(pass, report.impacts == 0, report.impact);
    report.impact_loss += before - after;
    system.distribute_impulses(frame);  // with the kinematics before the impact
    system.bilateral.add_work(problem, system.velocity.data(), m, phase);
    system.trees.scatter(problem, m.x.qd);
    forward_kinematics(m.model(), m.x, m.k);
    for (ConstraintSource* source : system.sources) source->extend_detection(m.k, h);
  }
  return passes;
}

// Convex combination of the inelastic solution in `problem` and the elastic one (velocities
// elastic_, impulses elastic_p_) with at most the energy before the impact. Both impulses lie in
// convex cones, and so does the combination. Returns the energy after the impact.
double Impacts::blend_towards_elastic(ImpulseProblem& problem) {
  double* v = problem.v(0);
  const std::size_t nv = problem.nv();
  const double before = kinetic_energy(problem, problem.v0(0)),
               plastic = kinetic_energy(problem, v);
  for (std::size_t k = 0; k < nv; ++k) elastic_[k] -= v[k];
  const double square = kinetic_energy(problem, elastic_.data());
  const double cross = mass_product(problem, v, elastic_.data());  // d/ds of the energy at s = 0
  // square s^2 + cross s + plastic = before
  const double allowed = std::max(0.0, before - plastic);
  const double root = std::sqrt(cross * cross + 4 * square * allowed);
  const double s =
      allowed > 0 ? std::clamp(2 * allowed / (cross + root), 0.0, 1.0) : 0;  // never 0 / 0
  for (std::size_t k = 0; k < nv; ++k) v[k] += s * elastic_[k];
  for (std::size_t i = 0; i < problem.constraints().size(); ++i)
    for (std::size_t r = 0; r < 3; ++r) {
      double& p = problem.constraints()[i].p[r];
      p += s * (elastic_p_[3 * i + r] - p);
    }
  return kinetic_energy(problem, v);
}

}  // namespace twinarm
