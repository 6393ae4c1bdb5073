// Parts of the impulse solver: envelope LU, cone algebra; and convergence if a contact
// velocity is a small difference of large numbers.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <random>

#include "solver/dynamics/dynamics.h"
#include "solver/impulses/impulse_solver.h"
#include "solver/linear_algebra/envelope_lu.h"
#include "solver/linear_algebra/second_order_cone.h"
#include "tests/solver/impulses/impulse_problems.h"

using namespace twinarm;
using namespace twinarm::testing;

TEST_CASE("a problem without constraints takes no memory for its mass matrix") {
  ImpulseProblem problem;
  problem.add_tree(3000000);  // 72 TB
  CHECK(problem.nv() == 3000000);
  problem.clear();
  problem.add_tree(2);
  CHECK(problem.M(0)[3] == 0);
}

TEST_CASE("a solver used on other bodies, more or fewer, gives the bits of a fresh one") {
  Random random(22);
  ImpulseSolver used;
  for (unsigned n = 0; n < 200; ++n) {
    const unsigned seed = n / 2;  // each twice: the second is solved with the factors of the first
    const int bodies = static_cast<int>(1 + seed % 5);
    ImpulseProblem problem = random_problem(seed, bodies, 2 * bodies, 100);
    if (n % 2 == 1)
      for (std::size_t k = 7; k < 36; k += 7) problem.M(bodies - 1)[k] += random.uniform(0, 1);
    ImpulseProblem again = problem;
    used.solve(problem);
    ImpulseSolver fresh;
    fresh.solve(again);
    REQUIRE(std::equal(again.v(0), again.v(0) + again.nv(), problem.v(0)));
  }
}

TEST_CASE("envelope LU agrees with a dense factorisation, symmetric or not") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  const std::vector<std::size_t> first{0, 0, 1, 0, 3, 2, 6, 4};
  const std::size_t n = first.size();
  for (const bool symmetric : {true, false}) {
    EnvelopeLu lu;
    for (const std::size_t f : first) lu.add_row(f);
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(8, 8);
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t k = first[r]; k <= r; ++k) {
        const double below = r == k ? 5 : unit(random), above = symmetric ? below : unit(random);
        *lu.row(r, k) = A(static_cast<int>(r), static_cast<int>(k)) = below;
        if (k < r) *lu.column(r, k) = A(static_cast<int>(k), static_cast<int>(r)) = above;
      }
    Eigen::VectorXd b = Eigen::VectorXd::Random(8), x = b;
    lu.factorise(symmetric);
    lu.solve(x.data());
    CHECK((A * x - b).norm() < 1e-14);
  }
}

TEST_CASE("Nesterov-Todd scaling maps x and z to the same point") {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    const auto inside = [&] {
      ConeVec x{0, unit(random), unit(random)};
      x[0] = std::hypot(x[1], x[2]) + std::pow(10.0, 3 * unit(random) - 2);
      return x;
    };
    const ConeVec x = inside(), z = inside();
    const ConeScaling s = nesterov_todd(x, z);
    const ConeVec back = times(s.W, s.t), W2z = times(s.W2, z);
    for (int r = 0; r < 3; ++r) {
      CHECK(back[r] == doctest::Approx(x[r]).epsilon(1e-8));
      CHECK(W2z[r] == doctest::Approx(x[r]).epsilon(1e-8));
    }
    const ConeVec y = jordan_solve(s.t, jordan(s.t, z));
    for (int r = 0; r < 3; ++r) CHECK(y[r] == doctest::Approx(z[r]).epsilon(1e-7));
    const ConeVec d{unit(random), unit(random), unit(random)};
    const double step = cone_step(x, d);
    if (step > 1e6) continue;  // never leaves the cone
    const ConeVec end{x[0] + step * d[0], x[1] + step * d[1], x[2] + step * d[2]};
    CHECK(std::abs(end[0] - std::hypot(end[1], end[2])) < 1e-9 * (1 + step));
    const ConeVec before{x[0] + 0.999 * step * d[0], x[1] + 0.999 * step * d[1],
                         x[2] + 0.999 * step * d[2]};
    CHECK(before[0] > std::hypot(before[1], before[2]));
  }
}

// u of the contact is 0 to rounding, a sum of terms as large as the rim speed. If it sticks,
// p = -(J M^-1 J^T)^-1 (J v0).
TEST_CASE(
    "a small body that rolls fast: residual 1e-11 m/s by augmented Lagrangian in most cases") {
  Random random(3);
  int held_ones = 0, far = 0;
  for (int trial = 0; trial < 300; ++trial) {
    CAPTURE(trial);
    const double mass = random.uniform(0.01, 1), radius = random.uniform(0.01, 0.1);
    ImpulseProblem problem;
    problem.add_tree(6);
    for (int k = 0; k < 3; ++k) {
      problem.M(0)[7 * k] = mass * radius * radius * random.uniform(0.25, 0.5);
      problem.M(0)[7 * (3 + k)] = mass;
    }
    const Vector3 r = radius * random.vector(1).normalized(), w = random.vector(30);
    const Vector3 v =
        -w.cross(r) + 1e-4 * Vector3(random.uniform(-1, 1), random.uniform(-1, 1), -5);
    ImpulseConstraint& c =
        problem.add(ConstraintType::coulomb_cone, 3, ImpulseConstraint::no_tree, 0);
    c.mu = 1.5;
    Eigen::Matrix<double, 3, 6> J;
    for (int row = 0; row < 3; ++row) {
      const Vector3 e = Vector3::Unit((row + 2) % 3), lever = r.cross(e);  // z, x, y
      J.row(row) << lever.transpose(), e.transpose();
      for (int k = 0; k < 6; ++k) problem.J(c, 1)[6 * row + k] = J(row, k);
    }
    for (int k = 0; k < 3; ++k) problem.v0(0)[k] = w[k], problem.v0(0)[3 + k] = v[k];
    const Eigen::Map<const Eigen::Matrix<double, 6, 6>> M(problem.M(0));
    const Eigen::Map<const Eigen::Matrix<double, 6, 1>> v0(problem.v0(0));
    const Vector3 held = -(J * M.inverse() * J.transpose()).inverse() * (J * v0);
    if (std::hypot(held[1], held[2]) > c.mu * held[0]) continue;  // it slides
    for (int k = 0; k < 3; ++k) c.p[k] = held[k] * (1 + random.uniform(-1, 1) * 1e-3);
    ImpulseSolver solver;
    solver.accuracy = {.good_guess = 1e-14, .accepted = 1e-11, .tolerance = 1e-13};
    const ImpulseReport report = solver.solve(problem);
    CHECK(report.residual <= solver.accuracy.accepted);
    ++held_ones, far += report.interior > 0;
    for (int k = 0; k < 3; ++k)
      CHECK(std::abs(problem.constraints()[0].p[k] - held[k]) < 1e-11 * mass);
  }
  CHECK(held_ones > 200);
  CHECK(far < held_ones / 20);
}

// With a large rho, a guess that is too large is projected to zero impulse; iterations with frozen
// shift then converge linearly with factor mu.
TEST_CASE("a sliding point converges in a few steps from too large a guess") {
  const double mass = 2, mu = 0.3, falls = 0.05, slides = 0.4;
  for (const double factor : {0.2, 0.9, 1.1, 1.5, 3.0}) {
    ImpulseProblem problem;
    problem.add_tree(3);
    for (int k = 0; k < 3; ++k) problem.M(0)[4 * k] = mass;
    problem.v0(0)[0] = slides, problem.v0(0)[2] = -falls;
    ImpulseConstraint& c =
        problem.add(ConstraintType::coulomb_cone, 3, 0, ImpulseConstraint::no_tree);
    c.mu = mu;
    problem.J(c, 0)[2] = problem.J(c, 0)[3] = problem.J(c, 0)[7] = 1;
    c.p = {factor * mass * falls, -mu * factor * mass * falls, 0};
    ImpulseSolver solver;
    const ImpulseReport report = solver.solve(problem);
    CAPTURE(factor);
    CHECK(report.newton <= 8);
    CHECK(report.interior == 0);
    CHECK(std::abs(problem.v(0)[2]) < 1e-11);
    CHECK(std::abs(problem.v(0)[0] - (slides - mu * falls)) < 1e-11);
  }
}
