// The check that loops stay closed, on loops whose forces come from the dense equations.
#include <doctest/doctest.h>

#include <algorithm>
#include <optional>

#include "app/inspect/cross_checks.h"
#include "solver/dynamics/dynamics.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "solver/loops/loop_closure.h"
#include "tests/solver/dynamics/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A loop of this type that is closed at x.
LoopClosure closed_at(Random& random, const Model<double>& model, const State<double>& x,
                      LoopType type) {
  Kinematics k(model);
  forward_kinematics(model, x, k);
  LoopClosure loop{facts_of(type).name, type};
  const bool of_joints = facts_of(type).ends != LoopBetween::bodies;
  loop.body_a = model.body_count() - 1;
  loop.body_b = of_joints ? loop.body_a - 1 : random.integer(0, 1);
  loop.X_LaC = {random.rotation(), random.vector(0.5)};
  const auto a = static_cast<std::size_t>(loop.body_a), b = static_cast<std::size_t>(loop.body_b);
  const Pose X_WC = k.X_WL[a] * loop.X_LaC;
  loop.X_LbC = k.X_WL[b].inverse() * X_WC;
  if (type == LoopType::distance) loop.X_LbC.p += random.vector(0.4);
  loop.length = (k.X_WL[a] * loop.X_LaC.p - k.X_WL[b] * loop.X_LbC.p).norm();
  loop.ratio = random.uniform(-2, 2);
  // A fixed last joint has no coordinate; check_loops() rejects it.
  const auto q = [&](std::size_t i) { return model.iq[i] < x.q.size() ? x.q[model.iq[i]] : 0.0; };
  loop.offset = q(a) - (type == LoopType::gear ? loop.ratio * q(b) : 0);
  return loop;
}

struct Closed {
  Model<double> model;
  State<double> x;
  std::vector<LoopClosure> loops;
  VectorXd along, force;  // share of the force by gamma; J^T lambda
};

// Velocities that satisfy the loop, and M qdd + h = J^T lambda with J qdd + gamma = 0. Empty for a
// singular loop.
std::optional<Closed> try_closed(Random& random, const std::vector<JointType>& types,
                                 LoopType type) {
  Closed c{random_tree(random, 6, types), {}, {}, {}, {}};
  c.x = random_state(random, c.model);
  c.loops = {closed_at(random, c.model, c.x, type)};
  try {
    check_loops(c.model, c.loops);
  } catch (const InputError&) {
    return std::nullopt;
  }
  LoopClosures loops(c.model, c.loops);
  const auto nv = static_cast<Index>(c.model.nv);
  Kinematics k(c.model);
  forward_kinematics(c.model, c.x, k);
  loops.evaluate(c.x, k);
  Eigen::Map<VectorXd> qd(c.x.qd.data(), nv);
  qd -= min_solution(loops.J(), loops.rate());
  forward_kinematics(c.model, c.x, k);
  loops.evaluate(c.x, k);
  const Inspection free(c.model, c.x, {});
  const VectorXd without = Eigen::Map<const VectorXd>(free.w.qdd.data(), nv);
  const MatrixXd M = mass_matrix(c.model, c.x), J = loops.J();
  const MatrixXd A = J * solve_symmetric(M, J.transpose());
  if (A.norm() == 0 || symmetric_eigenvalues(A)[0] < 1e-6 * A.norm() || loops.rate().norm() > 1e-12)
    return std::nullopt;
  c.force = J.transpose() * min_solution(A, -(J * without + loops.gamma()), 1e-12);
  c.along = J.transpose() * min_solution(A, loops.gamma(), 1e-12);
  return c;
}
Closed random_closed(Random& random, const std::vector<JointType>& types, LoopType type) {
  while (true)
    if (std::optional<Closed> found = try_closed(random, types, type)) return *found;
}

Check check_of(const Closed& c, const VectorXd& force) {
  Forces<double> forces(c.model);
  for (std::size_t dof = 0; dof < c.model.nv; ++dof)
    forces.tau[dof] = force[static_cast<Index>(dof)];
  const Inspection in(c.model, c.x, {actor_of("constraint/" + c.loops[0].name, forces)}, c.loops);
  const std::vector<Check> checks = run_checks(in);
  const auto found = std::find_if(checks.begin(), checks.end(),
                                  [](const Check& check) { return check.name == "loops"; });
  REQUIRE(found != checks.end());
  return *found;
}

}  // namespace

TEST_CASE(
    "the acceleration of the dense equations keeps every loop closed; without gamma it does not") {
  Random random(41);
  int moving = 0;
  for (const LoopTypeFacts& facts : all_loop_types()) {
    double worst = 0;
    for (int trial = 0; trial < 20; ++trial) {
      CAPTURE(facts.name);
      CAPTURE(trial);
      const bool of_joints = facts.ends != LoopBetween::bodies;
      const Closed c = random_closed(
          random, of_joints ? std::vector{JointType::revolute, JointType::prismatic} : kAllJoints,
          facts.type);
      const Check good = check_of(c, c.force);
      CHECK_MESSAGE(good.pass(), good.error);
      worst = std::max(worst, good.error);
      // As if J qdd = 0: undetected by all other checks.
      const Check bad = check_of(c, c.force + c.along);
      if (c.along.norm() < 1e-3) continue;  // gamma is zero
      ++moving;
      CHECK_FALSE(bad.pass());
      CHECK(bad.worst == facts.name);
    }
    MESSAGE(std::string(facts.name), ": ", worst);
  }
  CHECK(moving > 60);
}

TEST_CASE("loop check: an error of 1e-6 in the loop force is detected") {
  Random random(42);
  const Closed c = random_closed(random, {JointType::revolute}, LoopType::ball);
  CHECK(check_of(c, c.force).pass());
  CHECK_FALSE(check_of(c, (1 + 1e-6) * c.force).pass());
}

TEST_CASE("loop check: a mimic joint with a wrong acceleration is named") {
  Random random(43);
  std::vector<TreeBody> bodies = random_bodies(random, 4, {JointType::revolute});
  Model<double> model = build(bodies);
  model.mimics.push_back({model.iv[4], model.iv[1], model.iq[4], model.iq[1], 2.0, 0.0});
  State<double> x = random_state(random, model);
  Inspection in(model, x, {});
  const auto error = [&] { return loop_errors(in).at(0); };
  CHECK(error().first == "joint4");
  CHECK(error().second > 1e-3);
  in.w.qdd[model.iv[4]] = 2 * in.w.qdd[model.iv[1]];
  CHECK(error().second < 1e-12);
}
