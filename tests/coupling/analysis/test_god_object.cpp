// God object: on the KVR without obstacles, else the nearest motion that the contacts permit, in
// the metric of M.
#include <doctest/doctest.h>

#include "collision/contact/contact_constraints.h"
#include "coupling/laws/coupling_spec.h"
#include "solver/constraints/joint_limits.h"
#include "solver/support/diagnostics.h"
#include "tests/coupling/analysis/laws.h"
#include "tests/coupling/analysis/two_link.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

CouplingSpec god_object(const Model<double>& model) {
  CouplingSpec spec;
  spec.name = "god";
  spec.type = CouplingSpec::Type::god_object;
  spec.springs = god_object_joints(model, 1, model.body_count() - 1);
  return spec;
}
Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

// Gravity, armature, damping and Coulomb friction in every joint.
Model<double> rough_chain() {
  Random random(41);
  ModelBuilder builder;
  JointProperties rough;
  rough.armature = 0.2;
  rough.damping = 1.5;
  rough.coulomb_plus = 0.8;
  rough.coulomb_minus = 0.5;
  for (int i = 1; i <= 3; ++i)
    builder.add_body("link" + std::to_string(i), i - 1, "joint" + std::to_string(i),
                     i == 2 ? JointType::prismatic : JointType::revolute,
                     {random.rotation(), random.vector(0.4)}, random.vector(1), random.inertia(),
                     rough);
  return builder.build();
}

}  // namespace

TEST_CASE(
    "god object: without obstacles every step ends at the KVR, with friction and gravity or not") {
  const Model<double> model = rough_chain();
  Coupled system(model, hand_at({0.3, -0.2, 0.4}, {3, -0.5, -4}), kThreeJoints, god_object(model),
                 three_state(model, {1.3, 0.1, -0.4}, {-2, 1, 5}));
  for (int n = 0; n < 500; ++n) {
    system.simulation.step(1e-3);
    const State<double>&D = system.simulation.state(), &K = system.kvr.end().x;
    for (std::size_t j = 0; j < 3; ++j) {
      CHECK(std::abs(D.q[j] - K.q[j]) < 1e-11);
      if (n > 0) CHECK(std::abs(D.qd[j] - K.qd[j]) < 1e-8);
    }
  }
}

TEST_CASE("god object: a joint at its limit stays there, the others minimise |a - a_u| in M") {
  Random random(42);
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Model<double> model = chain_of_three(seed);
    const double h = 1e-3, limit = 0.2;
    const Vector3 q0(0.199, 0.3, -0.5);
    Coupled system(model, hand_at(q0, {1.5, -2, 3}), kThreeJoints, god_object(model),
                   three_state(model, q0, {1.5, -2, 3}));
    JointLimits limits(model);
    limits.add(1, -10, limit);
    system.simulation.add(limits);
    for (int n = 0; n < 100; ++n) {
      const Eigen::VectorXd q = vector_of(system.simulation.state().q);
      const Eigen::MatrixXd M = mass_matrix(model, system.simulation.state());
      system.simulation.step(h);
      const Eigen::VectorXd v = vector_of(system.simulation.state().qd);
      // In velocities: v_u reaches the KVR; v_1 is at most (limit - q_1)/h. A limit counts as
      // reached slightly before; overshoot is corrected by positions.
      Eigen::VectorXd nearest = (vector_of(system.kvr.end().x.q) - q) / h;
      const double excess = nearest[0] - std::max(0.0, limit - q[0] - JointLimits::kClosed) / h;
      if (excess > 0) {
        const Eigen::VectorXd e1 = Eigen::VectorXd::Unit(3, 0);
        const Eigen::VectorXd per_force = M.ldlt().solve(e1);
        nearest -= per_force * (excess / per_force[0]);
      }
      CHECK((v - nearest).norm() < 1e-8 * (1 + nearest.norm()));
      CHECK(system.simulation.state().q[0] < limit + 1e-9);
    }
    CHECK(system.kvr.end().x.q[0] > limit + 0.1);  // the KVR is beyond the limit
  }
}

TEST_CASE("god object: against a sphere it stays on the surface, and minimises |a - a_u| in M") {
  const TwoLink arm;
  const Model<double> model = arm.model();
  const double h = 1e-3, tip = 0.03, ball = 0.1;
  const Vector3 p_tip(arm.l2, 0, 0), p_ball(0.66, 0.02, 0);
  SteadyHand hand;
  hand.angle = {-0.6, 0.5, 0};
  hand.rate = {1.2, 0, 0};
  Coupled system(model, hand, {"joint1", "joint2"}, god_object(model),
                 state_of(model, {-0.6, 0.5}, {1.2, 0}));
  ContactConstraints contacts(model, ContactResponse::rigid);
  ContactSurface smooth;
  smooth.friction = 0;
  contacts.bodies().add({"tip", 2, {Matrix3::Identity(), p_tip}, Sphere{tip}, smooth, 0});
  contacts.bodies().add({"ball", 0, {Matrix3::Identity(), p_ball}, Sphere{ball}, smooth, 0});
  system.simulation.add(contacts);
  int pressed = 0, inside = 0;
  for (int n = 0; n < 900; ++n) {
    const Eigen::VectorXd q = vector_of(system.simulation.state().q);
    const Eigen::MatrixXd M = mass_matrix(model, system.simulation.state());
    const Kinematics D = system.simulation.kinematics();
    const Vector3 p = D.position(2, p_tip);
    const Vector3 normal = (p - p_ball).normalized();
    const Eigen::RowVectorXd J = normal.transpose() * point_jacobian(model, D, 2, p);
    double gap = (p - p_ball).norm() - tip - ball;
    system.simulation.step(h);
    if (!contacts.points().empty()) {  // within the accuracy of contact detection
      CHECK(std::abs(gap + contacts.points()[0].contact.depth) < 1e-7);
      gap = -contacts.points()[0].contact.depth;
    }
    const Eigen::VectorXd v = vector_of(system.simulation.state().qd);
    Eigen::VectorXd nearest = (vector_of(system.kvr.end().x.q) - q) / h;
    // > 0: it would penetrate. Depths up to 1e-6 are not corrected.
    const double closing = -std::max(0.0, gap - EventSource::kClosed) / h - (J * nearest)(0);
    if (closing > 0) {
      const Eigen::VectorXd per_force = M.ldlt().solve(J.transpose());
      nearest += per_force * (closing / (J * per_force)(0));
      ++pressed;
    }
    CHECK((v - nearest).norm() < 1e-6 * (1 + nearest.norm()));
    const Kinematics after = system.simulation.kinematics();
    CHECK((after.position(2, p_tip) - p_ball).norm() > tip + ball - 1e-5);
    inside += (system.kvr.end().k.position(2, p_tip) - p_ball).norm() < tip + ball - 0.01;
  }
  CHECK(pressed > 100);
  CHECK(inside > 100);
  // Beyond the sphere it is at the KVR again.
  for (std::size_t j = 0; j < 2; ++j)
    CHECK(std::abs(system.simulation.state().q[j] - system.kvr.end().x.q[j]) < 1e-9);
}

TEST_CASE("god object: rejects joints without a single coordinate, and incomplete robots") {
  ModelBuilder builder;
  const BodyInertia body{1, Vector3::Zero(), Matrix3::Identity()};
  builder.add_body("a", 0, "joint1", JointType::revolute, {}, Vector3::UnitZ(), body);
  builder.add_body("b", 1, "ball", JointType::spherical, {}, Vector3::UnitZ(), body);
  builder.add_body("c", 1, "joint2", JointType::revolute, {}, Vector3::UnitZ(), body);
  const Model<double> model = builder.build();
  const SteadyHand hand;
  TargetRobot kvr(model, hand, SteadyHand::mapping(), {{"joint1"}, "", 0, 0});
  CHECK_THROWS_AS(make_coupling(god_object(model), model, kvr), InputError);
  CouplingSpec half = god_object(model);
  half.springs = {{"joint1", 1}};
  try {
    make_coupling(half, model, kvr);
    FAIL("not refused");
  } catch (const InputError& error) {
    CHECK(error.faults().size() == 2);  // the spherical joint and joint2
  }
  half.springs = {{"joint2", 3}};
  CHECK_THROWS_AS(make_coupling(half, model, kvr), InputError);
}
