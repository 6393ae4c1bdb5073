// The PUMA 560, read from its URDF, against published and recomputed torques, which depend on all
// its parameters. The model built from tables: benchmarks/analytic/joints/puma560.cpp, F1.
#include <algorithm>
#include <cmath>

#include "benchmarks/analytic/joints/puma560_values.h"
#include "collision/import/robot/robot_model.h"
#include "collision/import/urdf/urdf.h"
#include "solver/dynamics/dynamics.h"
#include "tests/collision/import/robot/helpers.h"

namespace twinarm {
namespace {

using puma560::Joints;

// The robot's joints in order; the root link is fixed to the world.
Model<double> puma(bool armature, bool friction) {
  ModelOptions options;
  options.armature = armature;
  options.friction = friction;
  const fs::path folder = fs::path(TWINARM_SOURCE_DIR) / "assets" / "robots" / "puma560";
  return build_model(read_urdf(folder / "puma560.urdf"), options);
}
State<double> state(const Model<double>& model, const Joints& q, const Joints& qd = {}) {
  REQUIRE(model.nv == 6);
  State<double> x(model);
  std::copy(q.begin(), q.end(), x.q.begin());
  std::copy(qd.begin(), qd.end(), x.qd.begin());
  return x;
}
// Viscous and Coulomb friction oppose the rate.
Joints friction(const Model<double>& model, const Joints& qd) {
  Joints tau{};
  for (std::size_t k = 0; k < 6; ++k)
    tau[k] = model.damping[k] * qd[k] + (qd[k] > 0   ? model.coulomb_plus[k]
                                         : qd[k] < 0 ? -model.coulomb_minus[k]
                                                     : 0);
  return tau;
}
Joints inverse(const Model<double>& model, const State<double>& x, double qdd) {
  Workspace<double> w(model);
  rnea(model, x, std::vector<double>(6, qdd), std::vector<Force<double>>(model.parent.size()), w);
  Joints tau = friction(model, {x.qd[0], x.qd[1], x.qd[2], x.qd[3], x.qd[4], x.qd[5]});
  for (std::size_t k = 0; k < 6; ++k) tau[k] += w.tau[k];
  return tau;
}
// Relative to the largest entry.
double difference(const Joints& got, const Joints& expected) {
  double largest = 0, error = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    largest = std::max(largest, std::abs(expected[k]));
    error = std::max(error, std::abs(got[k] - expected[k]));
  }
  return error / largest;
}

TEST_CASE("F1: gravity torques of the PUMA 560 as published") {
  const Model<double> model = puma(true, true);
  for (const puma560::GravityLoad& load : puma560::kGravityLoads)
    CHECK(difference(inverse(model, state(model, load.q), 0), load.tau) < 1e-14);
}

TEST_CASE(
    "F1: inverse dynamics of the PUMA 560 from rest, moving with friction, and of its links") {
  const Model<double> model = puma(true, true), bare = puma(false, false);
  const Joints ones{1, 1, 1, 1, 1, 1};
  const Joints& qn = puma560::kNominal;
  CHECK(difference(inverse(model, state(model, qn), 1), puma560::kTauFromRest) < 1e-14);
  CHECK(difference(inverse(model, state(model, qn, ones), 1), puma560::kTauMoving) < 1e-14);
  CHECK(difference(inverse(bare, state(bare, qn, ones), 1), puma560::kTauMovingLinks) < 1e-14);
}

}  // namespace
}  // namespace twinarm
