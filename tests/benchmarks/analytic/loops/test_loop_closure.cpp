// Rows of loop closures, by finite differences of g along the motion and by virtual work; invalid
// loops.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <array>
#include <limits>

#include "benchmarks/analytic/mechanisms/loop_cases.h"
#include "solver/linear_algebra/pivoted_cholesky.h"
#include "solver/loops/loop_closure.h"
#include "solver/model/configuration.h"
#include "tests/solver/dynamics/random_tree.h"
#include "tests/support/count_allocations.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// One of each type in a random tree, between random links that can move relative to each other.
std::vector<LoopClosure> random_loops(Random& random, const Model<double>& model) {
  std::vector<int> one_dof;
  for (int i = 1; i < model.body_count(); ++i)
    if (model.dofs(static_cast<std::size_t>(i)) == 1) one_dof.push_back(i);
  std::vector<LoopClosure> loops;
  for (const LoopTypeFacts& facts : all_loop_types()) {
    LoopClosure loop{facts.name, facts.type};
    loop.X_LaC = {random.rotation(), random.vector(0.5)};
    loop.X_LbC = {random.rotation(), random.vector(0.5)};
    loop.length = random.uniform(0.1, 1);
    loop.ratio = random.uniform(-2, 2);
    loop.offset = random.uniform(-1, 1);
    const bool joints = facts.ends != LoopBetween::bodies;
    for (int tries = 0; tries < 20; ++tries) {
      if (joints && one_dof.size() < 2) break;
      const auto pick = [&] {
        return joints ? one_dof[static_cast<std::size_t>(
                            random.integer(0, static_cast<int>(one_dof.size()) - 1))]
                      : random.integer(0, model.body_count() - 1);
      };
      loop.body_a = pick(), loop.body_b = pick();
      try {
        check_loops(model, {loop});
      } catch (const InputError&) {
        continue;
      }
      loops.push_back(loop);
      break;
    }
  }
  return loops;
}
std::vector<std::vector<JointType>> lists_without_prescribed() {
  std::vector<std::vector<JointType>> lists;
  for (std::vector<JointType> list : lists_of_types()) {
    std::erase(list, JointType::prescribed);
    if (!list.empty()) lists.push_back(list);
  }
  return lists;
}
VectorXd g_at(const Model<double>& model, LoopClosures& loops, State<double> x,
              const std::vector<double>& shift, double part) {
  std::vector<double> scaled = shift;
  for (double& s : scaled) s *= part;
  integrate_coordinates(model, x.q, scaled, x.q);
  Kinematics k(model);
  forward_kinematics(model, x, k);
  loops.evaluate(x, k);
  return loops.g();
}
std::string what_of(const Model<double>& model, const std::vector<LoopClosure>& loops,
                    const State<double>& x) {
  try {
    check_loops(model, loops, x);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE(
    "loops: J, g' and gamma are differences of g along the motion, for every joint and type") {
  Random random(51);
  int checked = 0;
  for (const auto& types : lists_without_prescribed())
    for (int trial = 0; trial < 6; ++trial) {
      const Model<double> model = random_tree(random, 7, types);
      const State<double> x = random_state(random, model);
      LoopClosures loops(model, random_loops(random, model)), moved = loops;
      if (!loops.any()) continue;
      Kinematics k(model);
      forward_kinematics(model, x, k);
      loops.evaluate(x, k);

      // g' = J qd: no prescribed motion here.
      const VectorXd qd = Eigen::Map<const VectorXd>(x.qd.data(), static_cast<Index>(model.nv));
      CHECK((loops.rate() - loops.J() * qd).norm() < 1e-8);
      for (std::size_t d = 0; d < model.nv; ++d) {
        std::vector<double> e(model.nv);
        e[d] = 1;
        constexpr double s = 1e-5;
        const VectorXd column =
            (g_at(model, moved, x, e, s) - g_at(model, moved, x, e, -s)) / (2 * s);
        CHECK((loops.J().col(static_cast<Index>(d)) - column).norm() < 2e-8);
      }
      // q exp(t qd) has qdd = 0 for every joint. Fourth order.
      constexpr double s = 2e-3;
      const auto g = [&](double t) { return g_at(model, moved, x, x.qd, t); };
      const VectorXd second =
          (-g(2 * s) + 16 * g(s) - 30 * g(0) + 16 * g(-s) - g(-2 * s)) / (12 * s * s);
      CHECK((loops.gamma() - second).norm() < 2e-5 * (1 + second.norm()));
      ++checked;
    }
  CHECK(checked > 40);
}

TEST_CASE("loops: the power of the wrenches on both links is lambda g'") {
  Random random(52);
  for (int trial = 0; trial < 30; ++trial) {
    const Model<double> model = random_tree(random, 7, {JointType::revolute, JointType::spherical});
    const State<double> x = random_state(random, model);
    LoopClosures loops(model, random_loops(random, model));
    Kinematics k(model);
    forward_kinematics(model, x, k);
    loops.evaluate(x, k);
    const VectorXd lambda = VectorXd::NullaryExpr(static_cast<Index>(loops.rows()),
                                                  [&] { return random.uniform(-1, 1); });
    for (std::size_t l = 0; l < loops.loops().size(); ++l) {
      const LoopClosure& loop = loops.loops()[l];
      const auto rows = static_cast<Index>(facts_of(loop.type).rows);
      const auto first = static_cast<Index>(loops.first_row(l));
      if (facts_of(loop.type).ends != LoopBetween::bodies) continue;
      const auto a = static_cast<std::size_t>(loop.body_a),
                 b = static_cast<std::size_t>(loop.body_b);
      const Vector3 at_b = k.position(loop.body_b, loop.X_LbC.p);
      const Vector3 at_a =
          loop.type == LoopType::distance ? k.position(loop.body_a, loop.X_LaC.p) : at_b;
      const LoopWrench wrench = loops.wrench(l, lambda);
      const double power =
          wrench.couple.dot(k.w_WL[a] - k.w_WL[b]) +
          wrench.force.dot(k.velocity(loop.body_a, at_a) - k.velocity(loop.body_b, at_b));
      CHECK(power ==
            doctest::Approx(lambda.segment(first, rows).dot(loops.rate().segment(first, rows)))
                .epsilon(1e-12));
    }
  }
}

TEST_CASE("loops: rows contain exactly the dofs between their ends") {
  ModelBuilder builder;
  const BodyInertia cube{1, {0, 0, 0}, Matrix3::Identity()};
  builder.add_body("trunk", 0, "free", JointType::free, {}, Vector3::UnitZ(), cube);
  builder.add_body("left", 1, "l", JointType::revolute, {}, Vector3::UnitY(), cube);
  builder.add_body("right", 1, "r", JointType::revolute, {}, Vector3::UnitY(), cube);
  const Model<double> model = builder.build();
  LoopClosures loops(model, {{"grip", LoopType::weld, 2, 3}});
  CHECK(loops.rows() == 6);
  CHECK(loops.dofs_of(5) == std::vector<std::size_t>{6, 7});
}

TEST_CASE("loops: all errors at once, each with its fix") {
  const LoopCase c = slider_crank();
  const LoopClosure good = c.loops[0];
  std::vector<LoopClosure> loops(11, good);
  loops[1].name = "again";
  loops[2].name = "far", loops[2].body_a = 9;
  loops[3].name = "self", loops[3].body_b = loops[3].body_a;
  loops[4].name = "skew", loops[4].X_LaC.R *= 2;
  loops[5] = {"short", LoopType::distance, 1, 0};
  loops[6] = {"geared to itself", LoopType::gear, 1, 1};
  loops[7] = {"world locked", LoopType::locked, 0};
  loops[8] = {"nan", LoopType::locked, 1};
  loops[8].offset = std::numeric_limits<double>::quiet_NaN();
  loops[9].name = "open", loops[9].X_LbC.p.x() += 0.01;
  loops[10].name = "over", loops[10].X_LbC.p.y() = 0;
  loops[10].X_LbC.R = good.X_LbC.R * Vector3(1, -1, -1).asDiagonal();
  const std::string what = what_of(c.model, loops, c.start);
  CAPTURE(what);
  for (const char* text :
       {"loop 'again': duplicate of loop 'wrist'", "loop 'far': body a is 9, of 0 .. 3",
        "loop 'self': both ends are on the same rigid body",
        "loop 'skew': frame X_LaC or X_LbC is not finite", "loop 'short': length is 0 m",
        "loop 'geared to itself': both ends are the same joint",
        "loop 'world locked': the joint of body 0", "loop 'nan': ratio and offset must be finite",
        "loop 'open': position error is 0.01 (m or rad) in the initial state",
        "give initial joint positions", "loop 'over': axes of the two frames point"})
    CHECK(what.find(text) != std::string::npos);
  CHECK(what.find("'wrist': ") == std::string::npos);
  CHECK(what_of(c.model, c.loops, c.start).empty());
}

TEST_CASE("loops: gear and locked reject a joint of two dofs") {
  ModelBuilder builder;
  const BodyInertia cube{1, {0, 0, 0}, Matrix3::Identity()};
  builder.add_body("a", 0, "ball", JointType::spherical, {}, Vector3::UnitZ(), cube);
  builder.add_body("b", 0, "hinge", JointType::revolute, {}, Vector3::UnitZ(), cube);
  const Model<double> model = builder.build();
  const std::string what = what_of(
      model, {{"gear", LoopType::gear, 2, 1}, {"lock", LoopType::locked, 1}}, State<double>(model));
  CHECK(what.find("loop 'gear': the joint of body 1 (spherical) has 3 degrees") == 0);
  CHECK(what.find("loop 'lock': the joint of body 1 (spherical) has 3 degrees") !=
        std::string::npos);
}

TEST_CASE("loop factors: rank and solution of singular systems of any scale, against Eigen") {
  Random random(53);
  for (int trial = 0; trial < 200; ++trial) {
    const auto n = static_cast<Index>(random.integer(1, 9));
    const auto r = static_cast<Index>(random.integer(0, static_cast<int>(n)));
    const auto noise = [&] { return random.uniform(-1, 1); };
    VectorXd scale(n);
    for (Index i = 0; i < n; ++i) scale[i] = std::pow(10, random.uniform(-6, 6));
    const MatrixXd F = scale.asDiagonal() * MatrixXd::NullaryExpr(n, r, noise);
    const MatrixXd G = F * F.transpose();
    VectorXd b = G * (scale.cwiseInverse().cwiseAbs2().asDiagonal() *
                      VectorXd(scale.asDiagonal() * VectorXd::NullaryExpr(n, noise)));
    const VectorXd wanted = b;
    PivotedCholesky factors(9);
    std::array<double, 9> work;
    CHECK(allocations_in([&] {
            for (Index i = 0; i < n; ++i)
              for (Index j = 0; j < n; ++j)
                factors(static_cast<std::size_t>(i), static_cast<std::size_t>(j)) = G(i, j);
            factors.factorise(static_cast<std::size_t>(n));
            factors.solve(b.data(), work.data());
          }) == 0);
    CHECK(factors.rank() == static_cast<std::size_t>(r));
    CHECK(VectorXd(scale.cwiseInverse().asDiagonal() * VectorXd(G * b - wanted)).norm() < 1e-8);
  }
}
