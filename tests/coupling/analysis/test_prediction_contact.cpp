// Static deflection, torque at large angles and series stiffness, against equilibria of
// simulations.
#include <doctest/doctest.h>

#include "coupling/analysis/prediction.h"
#include "tests/coupling/analysis/one_joint.h"
#include "tests/coupling/analysis/two_link.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

constexpr double kMass = 2, kLink = 0.4, kG = 9.81;

// A point mass on a massless rod along x, with a horizontal axis: it falls as q grows.
Model<double> level_arm(int links) {
  ModelBuilder builder;
  for (int i = 0; i < links; ++i)
    builder.add_body(
        "link" + std::to_string(i + 1), i, "joint" + std::to_string(i + 1), JointType::revolute,
        {Matrix3::Identity(), {i == 0 ? 0 : kLink, 0, 0}}, Vector3::UnitY(),
        {kMass, {kLink, 0, 0}, kMass * kLink * kLink * Matrix3(Vector3(0, 1, 1).asDiagonal())});
  return builder.build();
}

// Equilibrium under gravity with a horizontal target, after a long time with strong damping.
std::vector<double> resting_pose(const Model<double>& model, CouplingSpec spec) {
  spec.discretization = Discretization::implicit;
  Coupled system(model, {}, {}, spec, State<double>(model));
  for (int n = 0; n < 40000; ++n) system.simulation.step(1e-3);
  for (const double qd : system.simulation.state().qd) CHECK(std::abs(qd) < 1e-6);
  return system.simulation.state().q;
}

}  // namespace

TEST_CASE("a horizontal link deflects by tau/k (torsional), by asin(tau/(k r^2)) (linear)") {
  // At the deflection q the load is m g l cos q.
  const Model<double> model = level_arm(1);
  const double k = 40;
  const double q =
      resting_pose(model, torsional({{"s", 1, Vector3::Zero(), k, 10}}, SpringSpace::joint))[0];
  CHECK(q == doctest::Approx(kMass * kG * kLink * std::cos(q) / k).epsilon(1e-6));
  const double k_L = 300, r = 0.3;
  const double p = resting_pose(model, linear({{"s", 1, {r, 0, 0}, k_L, 100}}))[0];
  const double sag = std::asin(kMass * kG * kLink * std::cos(p) / (k_L * r * r));
  CHECK(p == doctest::Approx(sag).epsilon(1e-6));
  CHECK(sag > 0.1);
}

TEST_CASE("a point spring's torque is k r^2 sin e: it repels beyond half a revolution") {
  const double k = 300, r = 0.3;
  const Model<double> model = one_joint(JointType::revolute, 1);
  for (const double e : {0.3, 1.2, 2.5, 3.5}) {
    Coupled system(model, {}, {}, linear({{"s", 1, {r, 0, 0}, k, 0}}), state_of(model, {-e}, {0}));
    system.simulation.step(1e-6);
    CHECK(system.simulation.state().qd[0] / 1e-6 ==
          doctest::Approx(k * r * r * std::sin(e)).epsilon(1e-5));
  }
}

TEST_CASE("a chain deflects by K_q^-1 G, with torsional and with linear springs") {
  const Model<double> model = level_arm(2);
  const std::vector<Spring> springs{{"s1", 1, {0.35, 0, 0}, 4e4, 4e4},
                                    {"s2", 2, {0.4, 0, 0}, 3e4, 3e4}};
  const State<double> level(model);
  for (const CouplingSpec& spec : {torsional(springs, SpringSpace::joint),
                                   torsional(springs, SpringSpace::world), linear(springs)}) {
    Coupled system(model, {}, {}, spec, level);
    Kinematics k(model);
    forward_kinematics(model, level, k);
    // m g about each axis: both masses on the inner one.
    const Eigen::Vector2d load(kMass * kG * kLink + kMass * kG * 2 * kLink, kMass * kG * kLink);
    const Eigen::VectorXd sag = chain_sag(system.coupling->joint_space(k).K, load);
    const std::vector<double> q = resting_pose(model, spec);
    CHECK(q[0] == doctest::Approx(sag[0]).epsilon(2e-3));
    CHECK(q[1] == doctest::Approx(sag[1]).epsilon(2e-3));
  }
}

TEST_CASE(
    "a coordinate without stiffness has no deflection, nor has a load that no spring can balance") {
  const Eigen::MatrixXd K = Eigen::Vector2d(50, 0).asDiagonal();
  const Eigen::VectorXd sag = chain_sag(K, Eigen::Vector2d(2, 3));
  CHECK(sag[0] == doctest::Approx(0.04));
  CHECK(std::isnan(sag[1]));
  const Eigen::MatrixXd one_direction = (Eigen::Matrix2d() << 4, 2, 2, 1).finished();
  CHECK(std::isnan(chain_sag(one_direction, Eigen::Vector2d(1, 1))[0]));
}

TEST_CASE("a wall behind a coupling has the stiffness k_c k_e/(k_c + k_e)") {
  // A prismatic joint between its target, d away, and a wall spring at its start: two couplings.
  const double k_c = 700, k_e = 2000, d = 0.05;
  const Model<double> model = one_joint(JointType::prismatic, 1);
  SteadyHand hand;
  hand.angle[0] = d;
  const SteadyHand still;
  TargetRobot wall(model, still, SteadyHand::mapping(), {{"joint1"}, "", 0, 0});
  CouplingSpec spec = linear({{"c", 1, Vector3::Zero(), k_c, 300}}, Discretization::implicit);
  Coupled system(model, hand, {"joint1"}, spec, State<double>(model));
  spec.springs[0].k = k_e;
  const auto at_wall = make_coupling(spec, model, wall);
  system.simulation.add(*at_wall);
  for (int n = 0; n < 20000; ++n) system.simulation.step(1e-3);
  CHECK(system.coupling->readings()[0].size / d ==
        doctest::Approx(series_stiffness(k_c, k_e)).epsilon(1e-9));
  CHECK(series_stiffness(k_c, kNoLimit) == k_c);
  CHECK(series_stiffness(kNoLimit, k_e) == k_e);
}
