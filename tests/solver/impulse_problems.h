// Random problems of impulses, and the laws as one would check them by hand: in their plain form,
// without projections.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "solver/impulse_solver.h"

namespace twinarm::testing {

// `trees` bodies of 6 and of 2 dofs with masses up to `ratio` apart, `contacts` laws of all kinds
// between them or to the world.
inline ImpulseProblem random_problem(unsigned seed, int trees, int contacts, double ratio,
                                     bool contacts_only = false) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  ImpulseProblem problem;
  for (int t = 0; t < trees; ++t) {
    const int n = t % 3 == 2 ? 2 : 6;
    problem.add_tree(n);
    const double mass = std::pow(ratio, 0.5 * (unit(random) + 1));
    std::vector<double> A(static_cast<std::size_t>(n * n));
    for (double& a : A) a = unit(random);
    for (int r = 0; r < n; ++r)
      for (int k = 0; k < n; ++k) {
        double sum = r == k ? 0.5 : 0;
        for (int q = 0; q < n; ++q) sum += A[r * n + q] * A[k * n + q];
        problem.M(t)[r * n + k] = mass * sum;
      }
    for (int k = 0; k < n; ++k) problem.v0(t)[k] = unit(random);
  }
  for (int i = 0; i < contacts; ++i) {
    const int kind = contacts_only ? 0 : i % 5;
    const ImpulseLaw law = kind == 1   ? ImpulseLaw::at_least
                           : kind == 2 ? ImpulseLaw::within
                           : kind == 3 ? ImpulseLaw::disc
                           : kind == 4 ? ImpulseLaw::equal
                                       : ImpulseLaw::coulomb;
    const int rows = law == ImpulseLaw::coulomb ? 3 : law == ImpulseLaw::disc ? 1 + i % 2 : 1;
    int a = static_cast<int>(random() % static_cast<unsigned>(trees));
    int b = static_cast<int>(random() % static_cast<unsigned>(trees + 1)) - 1;
    if (a == b) b = ImpulseConstraint::no_tree;
    ImpulseConstraint& c = problem.add(law, rows, a, b);
    for (int side = 0; side < 2; ++side)
      if (c.tree[side] != ImpulseConstraint::no_tree)
        for (int k = 0; k < rows * problem.size(c.tree[side]); ++k)
          problem.J(c, side)[k] = unit(random);
    c.mu = 0.1 + 0.7 * std::abs(unit(random));
    c.low = -0.1 * std::abs(unit(random));
    c.high = 0.1 * std::abs(unit(random));
    c.radius = 0.2;
    c.of = i - i % 5;
    if (law == ImpulseLaw::coulomb || law == ImpulseLaw::at_least)
      c.b[0] = 0.2 * std::abs(unit(random));
  }
  return problem;
}

// The largest breach of a law, as velocity or impulse over a mass of 1.
inline double breach(const ImpulseProblem& problem, const ImpulseConstraint& c) {
  const double slip = std::hypot(c.u[1], c.u[2]), hold = std::hypot(c.p[1], c.p[2]);
  double worst = 0;
  const auto at_most_zero = [&](double x) { worst = std::max(worst, x); };
  const auto zero = [&](double x) { worst = std::max(worst, std::abs(x)); };
  switch (c.law) {
    case ImpulseLaw::equal:
      for (int r = 0; r < c.rows; ++r) zero(c.u[r]);
      break;
    case ImpulseLaw::coulomb:
      at_most_zero(hold - c.mu * c.p[0]);
      // What slips, slips against the force, which is then as large as it may be.
      zero(c.p[1] * c.u[1] + c.p[2] * c.u[2] + c.mu * c.p[0] * slip);
      [[fallthrough]];
    case ImpulseLaw::at_least:
      at_most_zero(-c.u[0]), at_most_zero(-c.p[0]), zero(c.u[0] * c.p[0]);
      break;
    case ImpulseLaw::within:
      at_most_zero(c.low - c.p[0]), at_most_zero(c.p[0] - c.high);
      zero(std::max(0.0, c.u[0]) * (c.p[0] - c.low) + std::min(0.0, c.u[0]) * (c.p[0] - c.high));
      break;
    case ImpulseLaw::disc: {
      const double radius = c.radius * problem.constraints()[c.of].p[0];
      const double speed = std::hypot(c.u[0], c.rows > 1 ? c.u[1] : 0);
      at_most_zero(std::hypot(c.p[0], c.rows > 1 ? c.p[1] : 0) - radius);
      zero(c.p[0] * c.u[0] + (c.rows > 1 ? c.p[1] * c.u[1] : 0) + radius * speed);
      break;
    }
    case ImpulseLaw::compliant:
      break;
  }
  return worst;
}

// Largest entry of M (v - v0) - J^T p over the largest of J^T p.
inline double imbalance(const ImpulseProblem& problem) {
  std::vector<double> f(problem.nv(), 0);
  for (const ImpulseConstraint& c : problem.constraints()) problem.add_transpose(c, c.p, f.data());
  double worst = 0, largest = 1e-300;
  for (int t = 0; t < problem.tree_count(); ++t)
    for (int r = 0; r < problem.size(t); ++r) {
      const int n = problem.size(t);
      double sum = -f[problem.first(t) + static_cast<std::size_t>(r)];
      largest = std::max(largest, std::abs(sum));
      for (int k = 0; k < n; ++k)
        sum += problem.M(t)[r * n + k] * (problem.v(t)[k] - problem.v0(t)[k]);
      worst = std::max(worst, std::abs(sum));
    }
  return worst / largest;
}

}  // namespace twinarm::testing
