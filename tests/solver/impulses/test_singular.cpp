// Factorisations report matrices that are singular or not positive definite.
#include <doctest/doctest.h>

#include <array>
#include <limits>

#include "solver/forces/joint_friction.h"
#include "solver/impulses/impulse_solver.h"
#include "solver/linear_algebra/block_matrices.h"
#include "solver/linear_algebra/dense_spd.h"
#include "solver/linear_algebra/envelope_lu.h"

using namespace twinarm;

namespace {

struct Entries {
  double a, b, c;  // [a b; b c]
  bool positive, regular;
};
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr std::array kMatrices{
    Entries{2, 1, 2, true, true},          Entries{1, 1, 1, false, false},
    Entries{0, 0, 1, false, false},        Entries{1, 2, 1, false, true},
    Entries{-1, 0, 1, false, true},        Entries{1, kNoNumber, 1, false, false},
    Entries{kNoNumber, 0, 1, false, false}};

}  // namespace

TEST_CASE("factorisations report zero, negative and non-finite pivots") {
  for (const Entries& of : kMatrices) {
    CAPTURE(of.a);
    CAPTURE(of.b);
    CAPTURE(of.c);
    DenseSpd dense(2);
    dense(0, 0) = of.a, dense(1, 0) = of.b, dense(1, 1) = of.c;
    CHECK(dense.factorise(2) == of.positive);

    const std::array A{of.a, of.b, of.b, of.c};
    std::array<double, 4> L{};
    CHECK(cholesky(A.data(), 2, L.data()) == of.positive);

    for (const bool symmetric : {true, false}) {
      EnvelopeLu lu;
      lu.add_row(0);
      lu.add_row(0);
      *lu.row(0, 0) = of.a;
      *lu.row(1, 0) = *lu.column(1, 0) = of.b;
      *lu.row(1, 1) = of.c;
      CHECK(lu.factorise(symmetric) == of.regular);
    }
  }
}

TEST_CASE("joint friction with a singular matrix is bounded and finite") {
  BoxLcp lcp(2);  // both rows are one: only the sum of the forces is determined
  for (std::size_t i = 0; i < 2; ++i) {
    lcp.rows.push_back({});
    lcp.rows[i].a = -1;
    lcp.rows[i].low = -3, lcp.rows[i].high = 3;
    for (std::size_t j = 0; j <= i; ++j) lcp.B(i, j) = lcp.B(j, i) = 1;
  }
  lcp.solve();
  CHECK(lcp.rows[0].f + lcp.rows[1].f == doctest::Approx(1));
}

TEST_CASE("impulses with a mass matrix that is not positive definite are not called converged") {
  for (const double mass : {1.0, 0.0, -1.0}) {
    ImpulseProblem problem;
    problem.add_tree(1);
    problem.M(0)[0] = mass;
    problem.v0(0)[0] = 0;
    const ImpulseConstraint& limit =
        problem.add(ConstraintType::unilateral, 1, 0, ImpulseConstraint::no_tree);
    problem.J(limit, 0)[0] = 1;
    ImpulseSolver solver;
    CHECK(solver.solve(problem).converged == (mass > 0));
  }
}
