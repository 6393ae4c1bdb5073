// Elimination of multipliers within the articulated-body recursion, against dense saddle-point
// systems.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>

#include "solver/dynamics/dynamics.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "solver/loops/loop_forces.h"
#include "tests/solver/dynamics/random_tree.h"
#include "tests/support/count_allocations.h"
#include "tests/support/eigen_vectors.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Mechanism {
  Model<double> model;
  std::vector<LoopClosure> loops;
  std::vector<std::size_t> held{};
};

LoopClosure closure(LoopType type, int a, int b, const Pose& X_LaC = {}, const Pose& X_LbC = {}) {
  LoopClosure loop;
  loop.name = std::to_string(a) + "-" + std::to_string(b);
  loop.type = type;
  loop.body_a = a, loop.body_b = b;
  loop.X_LaC = X_LaC, loop.X_LbC = X_LbC;
  loop.length = 1, loop.ratio = 0.7;
  return loop;
}

// Loops between bodies that are close to each other, and some across the tree.
Mechanism random_mechanism(Random& random, int bodies) {
  ModelBuilder builder;
  std::vector<std::string> one_dof;  // joints
  std::vector<int> of;
  const std::vector<TreeBody> tree = random_bodies(random, bodies, kAllJoints);
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const TreeBody& b = tree[i];
    const std::string name = std::to_string(i + 1);
    builder.add_body("body" + name, b.parent, "joint" + name, b.type, b.X_PJ, b.axis, b.inertia,
                     b.properties);
    if (facts_of(b.type).nv == 1)
      one_dof.push_back("joint" + name), of.push_back(static_cast<int>(i + 1));
  }
  if (one_dof.size() > 2) builder.add_mimic(one_dof.back(), one_dof[one_dof.size() / 2], -0.8, 0);
  if (one_dof.size() > 3) builder.add_mimic(one_dof[0], one_dof[one_dof.size() / 2], 1.3, 0);
  Mechanism m{builder.build(), {}};
  if (of.size() > 2) m.loops.push_back(closure(LoopType::gear, of[0], of[1]));
  for (int n = random.integer(1, bodies / 3); n > 0; --n) {
    const int a = random.integer(1, bodies), b = random.integer(std::max(0, a - 6), bodies);
    const Pose A{random.rotation(), random.vector(0.5)}, B{random.rotation(), random.vector(0.5)};
    const LoopType types[] = {LoopType::weld, LoopType::hinge, LoopType::ball, LoopType::distance};
    const LoopClosure loop = closure(types[random.integer(0, 3)], a, b, A, B);
    try {
      check_loops(m.model, {loop});
    } catch (const InputError&) {
      continue;  // no joint between them
    }
    m.loops.push_back(loop);
    if (loop.type == LoopType::hinge && random.integer(0, 1))  // redundant
      m.loops.push_back(closure(LoopType::ball, a, b, A, B));
  }
  for (int n = random.integer(0, 3); n > 0 && m.model.nv > 0; --n)
    m.held.push_back(static_cast<std::size_t>(random.integer(0, static_cast<int>(m.model.nv) - 1)));
  std::ranges::sort(m.held);
  m.held.erase(std::unique(m.held.begin(), m.held.end()), m.held.end());
  return m;
}

// Planar linkages of `count` loops: four-bars, each on the coupler of the one before or on the
// ground; or scissors, whose loops share a joint with the next.
enum class Linkage { row, side_by_side, scissors };
Mechanism linkage(Linkage type, int count) {
  ModelBuilder builder;
  std::vector<LoopClosure> loops;
  int bodies = 0;
  const auto add = [&](int parent, double x) {
    ++bodies;
    const std::string name = std::to_string(bodies);
    return builder.add_body("body" + name, parent, "joint" + name, JointType::revolute,
                            {Matrix3::Identity(), {x, 0.1 * bodies, 0}}, Vector3::UnitZ(),
                            {1, {0.5, 0, 0}, 0.1 * Matrix3::Identity()});
  };
  const auto close = [&](int a, int b) {
    loops.push_back(closure(LoopType::hinge, a, b, {Matrix3::Identity(), {1, 0, 0}}));
  };
  int base = 0, before = type == Linkage::scissors ? add(0, 0) : 0;
  if (type == Linkage::scissors) base = add(before, 0.5);
  for (int n = 0; n < count; ++n)
    if (type == Linkage::scissors) {
      const int bar = add(base, 1);
      base = add(bar, 0.5);
      close(base, before);
      before = bar;
    } else {
      const int crank = add(base, 0), rocker = add(base, 1), coupler = add(crank, 1);
      close(coupler, rocker);
      if (type == Linkage::row) base = coupler;
    }
  return {builder.build(), loops};
}

// A row of a mimic joint, a loop or a held velocity each.
MatrixXd rows_of(const Model<double>& model, const MatrixXd& J,
                 const std::vector<std::size_t>& held) {
  const auto mimics = index(model.mimics.size());
  MatrixXd A = MatrixXd::Zero(mimics + J.rows() + index(held.size()), index(model.nv));
  for (Index r = 0; r < mimics; ++r) {
    const Mimic& m = model.mimics[static_cast<std::size_t>(r)];
    A(r, index(m.follower)) = 1;
    A(r, index(m.leader)) = -m.ratio;
  }
  A.middleRows(mimics, J.rows()) = J;
  for (std::size_t h = 0; h < held.size(); ++h) A(mimics + J.rows() + index(h), index(held[h])) = 1;
  return A;
}

// y with M y = b + A^T lambda, A y = s, relative to its size.
VectorXd dense_solution(const MatrixXd& M, const MatrixXd& A, const VectorXd& b,
                        const VectorXd& s) {
  const Index n = M.rows(), m = A.rows();
  MatrixXd K = MatrixXd::Zero(n + m, n + m);
  K.topLeftCorner(n, n) = M;
  K.topRightCorner(n, m) = -A.transpose();
  K.bottomLeftCorner(m, n) = A;
  VectorXd right(n + m);
  right << b, s;
  return min_solution(K, right, 1e-11);
}

// Smallest eigenvalue of A M^-1 A^T, scaled to a unit diagonal, that is not rounding: the squared
// angle to a singular configuration.
double margin_of(const MatrixXd& A, const MatrixXd& M) {
  const MatrixXd G = A * M.llt().solve(A.transpose());
  const VectorXd scale =
      G.diagonal().unaryExpr([](double g) { return g > 0 ? 1 / std::sqrt(g) : 0; });
  const MatrixXd scaled = scale.asDiagonal() * G * scale.asDiagonal();
  const VectorXd eigenvalues = scaled.selfadjointView<Eigen::Lower>().eigenvalues();
  double margin = 1;
  for (const double e : eigenvalues)
    if (e > 1e-12) margin = std::min(margin, e);
  return margin;
}

// Of all rows, and of each loop alone, all other joints locked.
double margin_of(const LoopClosures& loops, const MatrixXd& A, const MatrixXd& M) {
  double margin = A.rows() == 0 ? 1 : margin_of(A, M);
  for (std::size_t r = 0; r < loops.rows(); ++r) {
    if (r != loops.first_row(loops.loop_of(r))) continue;
    const auto count = index(facts_of(loops.loops()[loops.loop_of(r)].type).rows);
    const std::vector<std::size_t>& dofs = loops.dofs_of(r);
    const MatrixXd rows = loops.J().middleRows(index(r), count);
    if (!dofs.empty()) margin = std::min(margin, margin_of(rows(Eigen::all, dofs), M(dofs, dofs)));
  }
  return margin;
}

// Returns false, and checks nothing, close to a singular configuration.
bool check(const Mechanism& m, Random& random) {
  const Model<double>& model = m.model;
  ConstraintForceSolver solver(model);
  solver.set_loops(LoopClosures(model, m.loops));
  const State<double> x = random_state(random, model);
  Kinematics k(model);
  forward_kinematics(model, x, k);
  solver.loops().evaluate(x, k);
  Workspace<double> w(model);
  aba(model, x, Forces<double>(model), w);
  const MatrixXd M = mass_matrix(model, x), J = solver.loops().J();
  const MatrixXd A = rows_of(model, J, {}), with_held = rows_of(model, J, m.held);
  if (margin_of(solver.loops(), A, M) < 1e-5) return false;
  const VectorXd v = VectorXd::NullaryExpr(M.rows(), [&] { return random.uniform(-1, 1); });
  const std::vector<double> some(v.begin(), v.end());
  const auto error = [](const VectorXd& y, const VectorXd& wanted) {
    return largest(y - wanted) / (1e-3 + largest(wanted));
  };

  // Forces b without held velocities: A y = 0.
  const std::vector<Force<double>> none(model.parent.size());
  std::vector<double> y(model.nv), mimic(model.nv), loop(model.nv);
  CHECK(allocations_in([&] {
          solver.prepare(w);
          minv_times(model, some, none, w);
          y = w.y;
          solver.project(y);
        }) == 0);
  VectorXd wanted = dense_solution(M, A, v, VectorXd::Zero(A.rows()));
  CHECK(error(vector_of(y), wanted.head(M.rows())) < 1e-10);
  solver.add_forces(mimic, loop);
  const VectorXd forces = vector_of(mimic) + vector_of(loop);
  CHECK(error(forces, A.transpose() * wanted.tail(A.rows())) < 1e-10);
  const auto rank =
      static_cast<std::size_t>(A.rows() == 0 ? 0 : pivoted_columns(A.transpose(), 1e-9).rank);
  CHECK(solver.rank() == rank);

  // A correction with held velocities that the rows allow: some z fulfils them.
  solver.prepare(w, m.held);
  const MatrixXd fixed = rows_of(model, MatrixXd(0, M.rows()), m.held);
  const VectorXd z = fixed.rows() == 0 ? v : VectorXd(v - min_solution(fixed, fixed * v, 1e-12));
  VectorXd s = VectorXd::Zero(with_held.rows());
  s.segment(index(model.mimics.size()), J.rows()) = J * z;
  solver.correction(-J * z, y);
  wanted = dense_solution(M, with_held, VectorXd::Zero(M.rows()), s);
  CHECK(error(vector_of(y), wanted.head(M.rows())) < 1e-10);

  // The same by a copy, after other factors; and the sum of its loops and mimic joints.
  ConstraintForceSolver copy(model);
  copy.set_loops(LoopClosures(model, m.loops));
  std::vector<double> again(model.nv), part(model.nv);
  CHECK(allocations_in([&] { copy.copy_factors(solver); }) == 0);
  solver.prepare(w);
  copy.correction(-J * z, again);
  CHECK(again == y);
  if (!m.held.empty() || !model.mimics.empty()) return true;
  std::vector<double> lambda(copy.loops().rows());
  copy.add_lambda(1, lambda);
  VectorXd sum = VectorXd::Zero(M.rows());
  for (std::size_t l = 0; l < m.loops.size(); ++l) {
    copy.correction_of_loop(l, lambda, part);
    sum += vector_of(part);
  }
  CHECK(error(sum, vector_of(y)) < 1e-10);
  return true;
}

}  // namespace

TEST_CASE(
    "loops: nested and redundant loops, mimic joints and held velocities solve the dense system") {
  Random random(97);
  int checked = 0;
  for (int trial = 0; trial < 300; ++trial) {
    CAPTURE(trial);
    checked += check(random_mechanism(random, random.integer(3, 24)), random);
  }
  CHECK(checked > 250);
}

TEST_CASE("loops: linkages of many loops solve the dense system") {
  Random random(98);
  for (const Linkage type : {Linkage::row, Linkage::side_by_side, Linkage::scissors})
    for (const int count : {1, 2, 5, 9}) {
      CAPTURE(count);
      int singular = 0;
      while (!check(linkage(type, count), random)) REQUIRE(++singular < 100);
    }
}

TEST_CASE("loops: entries and couplings of rows grow linearly with the number of loops") {
  for (const Linkage type : {Linkage::row, Linkage::side_by_side, Linkage::scissors}) {
    const auto bytes_of = [&](int count) {
      const Mechanism m = linkage(type, count);
      const LoopClosures loops(m.model, m.loops);
      std::vector<std::vector<std::size_t>> dofs;
      for (std::size_t l = 0; l < m.loops.size(); ++l)
        dofs.insert(dofs.end(), 2, loops.dofs_of(loops.first_row(l)));
      return bytes_in([&] { ConstraintElimination(m.model, dofs); });
    };
    CHECK(double(bytes_of(64)) < 2.1 * double(bytes_of(32)));
  }
}

TEST_CASE(
    "loops: couplings of rows that would need too much memory are refused before it is taken") {
  ModelBuilder builder;
  for (int i = 0; i < 1000; ++i)
    builder.add_body("body" + std::to_string(i), i, "joint" + std::to_string(i),
                     JointType::revolute, {}, Vector3::UnitX(),
                     {1, {0.5, 0, 0}, 0.1 * Matrix3::Identity()});
  const Model<double> model = builder.build();
  std::vector<std::vector<std::size_t>> dofs;
  for (std::size_t i = 1; i < 1000; ++i) dofs.push_back({i, 0});
  const std::size_t bytes = bytes_in([&] {
    CHECK_THROWS_WITH_AS(ConstraintElimination(model, dofs), doctest::Contains("too many loops"),
                         InputError);
  });
  CHECK(bytes < 100u << 20);
}
