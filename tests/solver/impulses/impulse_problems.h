// Random impulse problems, and a check of the constraint laws as inequalities, without projections.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "solver/impulses/impulse_solver.h"
#include "tests/solver/dynamics/random_tree.h"

namespace twinarm::testing {

// A free body, about 0.3 m in size; velocity (angular; linear) at its centre.
inline void add_body(ImpulseProblem& problem, Random& random, double mass) {
  const int tree = problem.add_tree(6);
  const BodyInertia body = random.inertia();
  for (int r = 0; r < 3; ++r) {
    for (int k = 0; k < 3; ++k) problem.M(tree)[6 * r + k] = mass * body.inertia(r, k) / body.mass;
    problem.M(tree)[7 * (3 + r)] = mass;
  }
  for (int k = 0; k < 6; ++k) problem.v0(tree)[k] = random.uniform(-1, 1);
}

// Adds the velocity along (or about) `axes` of a point at r from the centre to the rows.
inline void add_rows(ImpulseProblem& problem, const ImpulseConstraint& c, int side,
                     const Matrix3& axes, const Vector3& r, bool turn) {
  if (c.tree[side] == ImpulseConstraint::no_tree) return;
  const double sign = side == 0 ? -1 : 1;
  for (int row = 0; row < c.rows; ++row) {
    const Vector3 e = axes.col(row), lever = r.cross(e);
    for (int k = 0; k < 3; ++k) {
      problem.J(c, side)[6 * row + k] = sign * (turn ? e[k] : lever[k]);
      problem.J(c, side)[6 * row + 3 + k] = sign * (turn ? 0 : e[k]);
    }
  }
}

// Free bodies with masses up to `ratio` apart, and constraints of all types between them or to the
// world: contacts, limits, box friction, torsional and rolling friction, locks.
inline ImpulseProblem random_problem(unsigned seed, int bodies, int constraints, double ratio,
                                     bool contacts_only = false) {
  Random random(seed);
  ImpulseProblem problem;
  for (int t = 0; t < bodies; ++t) add_body(problem, random, std::pow(ratio, random.uniform(0, 1)));
  Matrix3 axes = Matrix3::Identity();
  for (int i = 0; i < constraints; ++i) {
    const int kind = contacts_only ? 0 : i % 5, of = i - i % 5;
    const ConstraintType law = kind == 1   ? ConstraintType::friction_disc
                               : kind == 2 ? ConstraintType::unilateral
                               : kind == 3 ? ConstraintType::box
                               : kind == 4 ? ConstraintType::bilateral
                                           : ConstraintType::coulomb_cone;
    const int rows = law == ConstraintType::coulomb_cone    ? 3
                     : law == ConstraintType::friction_disc ? 1 + of % 2
                                                            : 1;
    int a = random.integer(0, bodies - 1), b = random.integer(-1, bodies - 1);
    if (a == b) b = ImpulseConstraint::no_tree;
    if (law == ConstraintType::friction_disc)  // of the contact before it
      a = problem.constraints()[of].tree[0], b = problem.constraints()[of].tree[1];
    else
      axes = random.rotation();
    ImpulseConstraint& c = problem.add(law, rows, a, b);
    for (int side = 0; side < 2; ++side)
      add_rows(problem, c, side, axes, random.vector(0.2), law == ConstraintType::friction_disc);
    c.mu = random.uniform(0.1, 0.9);
    c.low = -random.uniform(0, 0.1);
    c.high = random.uniform(0, 0.1);
    c.radius = 0.005;
    c.of = of;
    if (law == ConstraintType::coulomb_cone || law == ConstraintType::unilateral)
      c.b[0] = random.uniform(0, 0.2);
  }
  return problem;
}

// Copy of constraint i, on trees with an offset.
inline void add_copy(ImpulseProblem& problem, std::size_t i, int shift) {
  const ImpulseConstraint original = problem.constraints()[i];
  const auto moved = [&](int t) { return t == ImpulseConstraint::no_tree ? t : t + shift; };
  ImpulseConstraint& c =
      problem.add(original.law, original.rows, moved(original.tree[0]), moved(original.tree[1]));
  c.mu = original.mu, c.b = original.b;
  for (int side = 0; side < 2; ++side)
    if (c.tree[side] != ImpulseConstraint::no_tree)
      std::copy_n(problem.J(original, side), c.rows * problem.size(c.tree[side]),
                  problem.J(c, side));
}

// Copies of the problem side by side, at velocities apart.
inline ImpulseProblem side_by_side(const ImpulseProblem& one, int copies) {
  ImpulseProblem all = one;
  const int trees = one.tree_count();
  for (int copy = 1; copy < copies; ++copy) {
    for (int t = 0; t < trees; ++t) {
      const int n = one.size(t), to = all.add_tree(n);
      std::copy_n(one.M(t), n * n, all.M(to));
      for (int k = 0; k < n; ++k) all.v0(to)[k] = (1 + 0.1 * copy) * one.v0(t)[k];
    }
    for (std::size_t i = 0; i < one.constraints().size(); ++i) add_copy(all, i, copy * trees);
  }
  return all;
}

// A pyramid of boxes of 1 kg and 0.1 m side, `levels` high, with random velocities while they
// touch: four contacts per pair, with restitution.
inline ImpulseProblem struck_pyramid(unsigned seed, int levels) {
  constexpr double half = 0.05, apart = 0.02;
  Random random(seed);
  ImpulseProblem problem;
  std::vector<std::array<double, 2>> at;  // x, z
  for (int level = 0; level < levels; ++level)
    for (int k = 0; k + level < levels; ++k)
      at.push_back({(k + 0.5 * level) * (2 * half + apart), half + 2 * half * level});
  for (std::size_t box = 0; box < at.size(); ++box) {
    const int t = problem.add_tree(6);
    for (int r = 0; r < 3; ++r)
      problem.M(t)[7 * r] = 2.0 / 3 * half * half, problem.M(t)[7 * (3 + r)] = 1;
    for (int k = 0; k < 6; ++k)
      problem.v0(t)[k] = k < 3 ? random.uniform(-2, 2) : random.uniform(-0.2, 0.2);
    problem.v0(t)[5] -= 0.2;
  }
  const double mu = random.uniform(0.2, 1), restitution = random.uniform(0, 0.5);
  Matrix3 axes;
  axes << 0, 1, 0, 0, 0, 1, 1, 0, 0;  // z, x, y
  const auto touch = [&](int a, int b, double x, double y, double z) {
    ImpulseConstraint& c = problem.add(ConstraintType::coulomb_cone, 3, a, b);
    for (int side = 0; side < 2; ++side)
      if (const int t = c.tree[side]; t != ImpulseConstraint::no_tree)
        add_rows(problem, c, side, axes, {x - at[t][0], y, z - at[t][1]}, false);
    c.mu = mu;
    std::array<double, 3> u;
    problem.velocity(c, problem.v0(0), u);
    c.b[0] = restitution * std::min(0.0, u[0]);
  };
  for (int b = 0; b < problem.tree_count(); ++b)
    for (int a = -1; a < b; ++a) {
      const double x_a = a < 0 ? at[b][0] : at[a][0], top = a < 0 ? 0 : at[a][1] + half;
      const double low = std::max(x_a, at[b][0]) - half, high = std::min(x_a, at[b][0]) + half;
      if (std::abs(at[b][1] - half - top) > 0.1 * half || low > high) continue;
      for (const double x : {low, high})
        for (const double y : {-half, half}) touch(a, b, x, y, top);
    }
  return problem;
}

// problems/NAME.txt: a problem from simulated scenes; free bodies. A line each: # and
// a comment; tree, the lower triangle of M, v0; or law, rows, trees of both sides (-1: none), of,
// mu or radius, b, the guess of p, J of both sides.
inline ImpulseProblem read_problem(const std::string& name) {
  std::ifstream in(TWINARM_SOURCE_DIR "/tests/solver/impulses/problems/" + name + ".txt");
  ImpulseProblem problem;
  for (std::string word; in >> word;) {
    if (word == "#") {
      std::getline(in, word);
      continue;
    }
    if (word == "tree") {
      const int t = problem.add_tree(6);
      for (int r = 0; r < 6; ++r)
        for (int k = 0; k <= r; ++k) {
          in >> problem.M(t)[6 * r + k];
          problem.M(t)[6 * k + r] = problem.M(t)[6 * r + k];
        }
      for (int k = 0; k < 6; ++k) in >> problem.v0(t)[k];
      continue;
    }
    int rows = 0, a = 0, b = 0, of = 0;
    in >> rows >> a >> b >> of;
    const bool disc = word == "disc";
    ImpulseConstraint& c = problem.add(
        disc ? ConstraintType::friction_disc : ConstraintType::coulomb_cone, rows, a, b);
    c.of = of;
    in >> (disc ? c.radius : c.mu);
    for (double& x : c.b) in >> x;
    for (double& x : c.p) in >> x;
    for (int side = 0; side < 2; ++side)
      if (c.tree[side] != ImpulseConstraint::no_tree)
        for (int k = 0; k < 6 * rows; ++k) in >> problem.J(c, side)[k];
  }
  return problem;
}

// Largest violation of a law, in m/s, N s, or J over 1 + |p|.
inline double breach(const ImpulseProblem& problem, const ImpulseConstraint& c) {
  const double slip = std::hypot(c.u[1], c.u[2]), hold = std::hypot(c.p[1], c.p[2]);
  double worst = 0;
  const auto at_most_zero = [&](double x) { worst = std::max(worst, x); };
  const auto zero = [&](double x) { worst = std::max(worst, std::abs(x)); };
  switch (c.law) {
    case ConstraintType::bilateral:
      for (int r = 0; r < c.rows; ++r) zero(c.u[r]);
      break;
    case ConstraintType::coulomb_cone:
      at_most_zero(hold - c.mu * c.p[0]);
      // Sliding: velocity opposite to the friction force, which is at its limit.
      zero(c.p[1] * c.u[1] + c.p[2] * c.u[2] + c.mu * c.p[0] * slip);
      [[fallthrough]];
    case ConstraintType::unilateral:
      at_most_zero(-c.u[0]), at_most_zero(-c.p[0]), zero(c.u[0] * c.p[0]);
      break;
    case ConstraintType::box:
      at_most_zero(c.low - c.p[0]), at_most_zero(c.p[0] - c.high);
      zero(std::max(0.0, c.u[0]) * (c.p[0] - c.low) + std::min(0.0, c.u[0]) * (c.p[0] - c.high));
      break;
    case ConstraintType::friction_disc: {
      const double radius = c.radius * problem.constraints()[c.of].p[0];
      const double speed = std::hypot(c.u[0], c.rows > 1 ? c.u[1] : 0);
      at_most_zero(std::hypot(c.p[0], c.rows > 1 ? c.p[1] : 0) - radius);
      zero(c.p[0] * c.u[0] + (c.rows > 1 ? c.p[1] * c.u[1] : 0) + radius * speed);
      break;
    }
    case ConstraintType::compliant:
      break;
  }
  return worst / (1 + std::abs(c.p[0]) + hold);
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
