// Sweeps over constraints, the accuracy and the budget of the impulse solver.
#include <doctest/doctest.h>

#include <numeric>

#include "solver/impulses/conjugate_sweeps.h"
#include "solver/linear_algebra/block_matrices.h"
#include "tests/solver/impulses/impulse_problems.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

// Sweeps from p = 0; sets v, p and u of the problem.
void sweep(ImpulseProblem& problem, int count) {
  ImpulseIsland::Members all;
  all.trees.resize(static_cast<std::size_t>(problem.tree_count()));
  all.constraints.resize(problem.constraints().size());
  std::iota(all.trees.begin(), all.trees.end(), 0);
  std::iota(all.constraints.begin(), all.constraints.end(), 0);
  ImpulseIsland island;
  REQUIRE(island.set(problem, all, {}));
  island.apply_impulses();
  ConjugateSweeps sweeps;
  sweeps.start(island);
  for (int k = 0; k < count; ++k) sweeps.sweep();
  sweeps.write_impulses();
  island.apply_impulses();
}

double kinetic_energy(const ImpulseProblem& problem, bool after) {
  double sum = 0;
  for (int t = 0; t < problem.tree_count(); ++t) {
    const int n = problem.size(t);
    const double* v = after ? problem.v(t) : problem.v0(t);
    for (int r = 0; r < n; ++r)
      for (int k = 0; k < n; ++k) sum += 0.5 * v[r] * problem.M(t)[r * n + k] * v[k];
  }
  return sum;
}

// On supports at rest.
ImpulseProblem pyramid(unsigned seed, int levels) {
  ImpulseProblem problem = struck_pyramid(seed, levels);
  for (ImpulseConstraint& c : problem.constraints()) c.b = {};
  return problem;
}

}  // namespace

// The first takes the direction of sliding from a multiplier that is good to 1e-6.
TEST_CASE("two sweeps solve a constraint alone, of every type") {
  for (unsigned seed = 0; seed < 400; ++seed)
    for (const std::size_t kind : {0u, 2u, 3u, 4u}) {
      CAPTURE(seed);
      CAPTURE(kind);
      ImpulseProblem problem = random_problem(seed, 2, 5, 10);
      problem.constraints() = {problem.constraints()[kind]};
      sweep(problem, 2);
      CHECK(breach(problem, problem.constraints()[0]) < 1e-9);
    }
}

TEST_CASE("sweeps converge to the laws of a contact with rolling or torsional friction") {
  for (unsigned seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    ImpulseProblem problem = random_problem(seed, 2, 2, 10);
    sweep(problem, 200);
    for (const ImpulseConstraint& c : problem.constraints()) CHECK(breach(problem, c) < 1e-7);
  }
}

// Hunt-Crossley and bristles, written out: N = h k d (1 + c s), T = -h (k_t a' + b_t u_t) up to mu
// N.
TEST_CASE("sweeps converge to the forces of compliant contacts") {
  for (unsigned seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    ImpulseProblem problem = random_problem(seed, 4, 6, 10, true);
    for (ImpulseConstraint& c : problem.constraints()) {
      c.law = ConstraintType::compliant;
      c.h = 1e-3, c.k = 1e5, c.c = 0.5, c.depth = 1e-3, c.k_t = 1e4, c.b_t = 10;
      c.anchor = {1e-4, -2e-4};
      c.b = {};
    }
    sweep(problem, 300);
    for (const ImpulseConstraint& c : problem.constraints()) {
      const double s = -c.u[0], depth = c.depth + c.h * s, factor = 1 + c.c * s;
      const double normal = depth > 0 && factor > 0 ? c.h * c.k * depth * factor : 0;
      CHECK(c.p[0] == doctest::Approx(normal).epsilon(1e-6));
      std::array<double, 2> t;
      for (int r = 0; r < 2; ++r)
        t[r] = -c.h * (c.k_t * (c.anchor[r] + c.h * c.u[1 + r]) + c.b_t * c.u[1 + r]);
      const double scale = std::min(1.0, c.mu * c.p[0] / std::hypot(t[0], t[1]));
      for (int r = 0; r < 2; ++r) CHECK(std::abs(c.p[1 + r] - scale * t[r]) < 1e-6);
    }
  }
}

TEST_CASE("an accuracy of 1e-4 m/s is met, by sweeps alone in random heaps") {
  int by_sweeps = 0;
  for (unsigned seed = 0; seed < 80; ++seed) {
    CAPTURE(seed);
    const bool is_heap = seed < 40;
    ImpulseProblem problem =
        is_heap ? random_problem(seed, 6, 18, 10, true) : struck_pyramid(seed, 5);
    ImpulseSolver solver;
    solver.accuracy.good_guess = solver.accuracy.accepted = 1e-4;
    solver.accuracy.tolerance = 2e-6;
    const ImpulseReport report = solver.solve(problem);
    CHECK(report.converged);
    CHECK(report.residual <= 1e-4);
    CHECK(report.sweeps > 0);
    by_sweeps += is_heap && report.interior == 0;
    // The residual is over the velocity and the projected impulse: u_n is not far below zero.
    for (const ImpulseConstraint& c : problem.constraints()) CHECK(c.u[0] > -1e-3);
  }
  CHECK(by_sweeps > 30);
}

TEST_CASE("up to eight contacts are solved exactly, whatever the accuracy") {
  for (unsigned seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    ImpulseProblem problem = random_problem(seed, 3, 8, 10, true);
    ImpulseSolver solver;
    solver.accuracy = {.good_guess = 1e-2, .accepted = 1e-2, .tolerance = 2e-4};
    CHECK(solver.solve(problem).residual <= ImpulseAccuracy{}.accepted);
  }
}

// Shaken once, with gravity in steps of 2 ms. An error of the impulses is an acceleration: a
// solution that is only just accepted must be solved again two steps later.
TEST_CASE("a pyramid at rest is seldom solved again at an accuracy of 1e-4 m/s") {
  ImpulseProblem problem = pyramid(1, 6);
  Random random(1);
  for (std::size_t k = 0; k < problem.nv(); ++k) problem.v0(0)[k] = random.uniform(-0.1, 0.1);
  ImpulseSolver solver;
  solver.accuracy = {.good_guess = 1e-4, .accepted = 1e-4, .tolerance = 2e-6};
  int solved = 0;
  for (int step = 0; step < 500; ++step) {
    for (int t = 0; t < problem.tree_count(); ++t) problem.v0(t)[5] -= 9.81 * 0.002;
    const ImpulseReport report = solver.solve(problem);
    CHECK(report.residual <= 1e-4);
    solved += report.solved;
    std::copy_n(problem.v(0), problem.nv(), problem.v0(0));
  }
  CHECK(solved < 20);
}

TEST_CASE("a budget is kept, gives the same bits again, and no energy") {
  for (unsigned seed = 0; seed < 20; ++seed)
    for (const double budget : {1e4, 1e5, 1e6, 1e7}) {
      CAPTURE(seed);
      CAPTURE(budget);
      ImpulseProblem problem = pyramid(seed, 6);
      for (ImpulseConstraint& c : problem.constraints()) c.p = {1, 0.1, 0};  // far too large
      ImpulseProblem again = problem;
      ImpulseSolver solver, other;
      solver.accuracy.budget = other.accuracy.budget = budget;
      const ImpulseReport report = solver.solve(problem);
      other.solve(again);
      CHECK(std::equal(problem.v(0), problem.v(0) + problem.nv(), again.v(0)));
      CHECK(std::isfinite(report.residual));
      CHECK(report.sweeps * 84 * 172 <= budget + 84 * 172);  // at least 172 operations a contact
      CHECK(imbalance(problem) < 1e-10);
      const double before = kinetic_energy(problem, false);
      CHECK(kinetic_energy(problem, true) <= before * (1 + 1e-12));
    }
}

TEST_CASE("a larger budget leaves smaller residuals") {
  double last = 1e300;
  for (const double budget : {1e5, 1e6, 1e7, 1e10}) {
    double sum = 0;
    for (unsigned seed = 0; seed < 20; ++seed) {
      ImpulseProblem problem = pyramid(seed, 6);
      ImpulseSolver solver;
      solver.accuracy.budget = budget;
      sum += solver.solve(problem).residual;
    }
    CAPTURE(budget);
    CHECK(sum < 0.5 * last);
    last = sum;
  }
  CHECK(last < 20 * 5e-9);
}
