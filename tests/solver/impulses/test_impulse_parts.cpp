// Parts of the impulse solver: envelope LU, cone algebra, blocks of M; and convergence if a contact
// velocity is a small difference of large numbers.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <random>

#include "solver/constraints/kinematic_trees.h"
#include "solver/dynamics/dynamics.h"
#include "solver/impulses/impulse_solver.h"
#include "solver/linear_algebra/envelope_lu.h"
#include "solver/linear_algebra/second_order_cone.h"
#include "tests/solver/dynamics/random_tree.h"

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

TEST_CASE("constraints on a robot of more than 4000 joints are refused before memory is taken") {
  ModelBuilder builder;
  for (int k = 0; k < 4001; ++k)
    builder.add_body("b" + std::to_string(k), k, "j" + std::to_string(k), JointType::revolute,
                     Pose{}, Vector3::UnitX(), {1, Vector3::Zero(), Matrix3::Identity()});
  const Model<double> model = builder.build();
  KinematicTrees trees(model);
  ImpulseProblem problem;
  trees.add_to(problem);
  Workspace<double> w(model);
  CHECK_THROWS_WITH_AS(trees.set_mass_matrix(problem, nullptr, w), doctest::Contains("too many"),
                       InputError);
}

TEST_CASE("blocks of the trees are the mass matrix, rows are the Jacobians") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const std::vector<JointType> types(all_joint_types.begin(), all_joint_types.end());
    const Model<double> model = random_tree(random, 2 + static_cast<int>(seed) % 9, types);
    const State<double> x = random_state(random, model);
    Workspace<double> w(model);
    const Eigen::MatrixXd M = mass_matrix(model, x);
    kinematics(model, x, w);
    KinematicTrees trees(model);
    ImpulseProblem problem;
    trees.add_to(problem);
    trees.set_mass_matrix(problem, nullptr, w);
    for (std::size_t a = 0; a < model.nv; ++a)
      for (std::size_t b = 0; b < model.nv; ++b) {
        const int t = trees.tree_of_dof(a);
        const auto n = static_cast<std::size_t>(problem.size(t));
        const auto row = static_cast<Eigen::Index>(a), column = static_cast<Eigen::Index>(b);
        const double entry = t == trees.tree_of_dof(b)
                                 ? problem.M(t)[trees.index_in_tree(a) * n + trees.index_in_tree(b)]
                                 : 0;
        CHECK(entry == doctest::Approx(M(row, column)).epsilon(1e-12).scale(1));
      }
    Kinematics k(model);
    forward_kinematics(model, x, k);
    for (int body = 1; body < model.body_count(); ++body) {
      const int t = trees.tree_of(body);
      if (t == ImpulseConstraint::no_tree) continue;
      const auto n = static_cast<std::size_t>(problem.size(t));
      std::vector<double> J(3 * n);
      const Vector3 p(0.3, -0.2, 0.5);
      trees.add_point_rows(k, body, p, Matrix3::Identity(), 3, 1, J.data());
      const Eigen::Matrix3Xd expected = point_jacobian(model, k, body, p);
      for (std::size_t dof = 0; dof < model.nv; ++dof)
        for (int r = 0; r < 3; ++r) {
          const double entry = trees.tree_of_dof(dof) == t
                                   ? J[static_cast<std::size_t>(r) * n + trees.index_in_tree(dof)]
                                   : 0;
          CHECK(entry == doctest::Approx(expected(r, static_cast<int>(dof))).scale(1));
        }
    }
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
