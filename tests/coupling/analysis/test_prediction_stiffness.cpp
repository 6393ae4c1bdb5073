// K_q about a pose with the geometric part, against analytic second derivatives.
#include <doctest/doctest.h>

#include "coupling/analysis/prediction.h"
#include "solver/forces/spring.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "tests/coupling/analysis/one_joint.h"
#include "tests/coupling/analysis/two_link.h"
#include "tests/solver/dynamics/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

Model<double> random_arm(Random& random, int links) {
  std::vector<TreeBody> bodies;
  for (int i = 0; i < links; ++i) {
    TreeBody body;
    body.parent = i;
    body.type = i == 2 ? JointType::prismatic : JointType::revolute;
    body.X_PJ = {random.rotation(), random.vector(0.4)};
    body.axis = random.vector(1).normalized();
    body.inertia = random.inertia();
    bodies.push_back(body);
  }
  return build(bodies);
}

State<double> random_pose(Random& random, const Model<double>& model) {
  State<double> x(model);
  for (double& q : x.q) q = random.uniform(-1, 1);
  return x;
}

}  // namespace

// dJ_j/dq_i = w_a x J_b, a the one of i and j nearer to the base, b the other.
TEST_CASE("the geometric stiffness of a point spring is minus the derivative of its lever arms") {
  Random random(8);
  const Model<double> model = random_arm(random, 5);
  const State<double> x = random_pose(random, model);
  Kinematics k = kinematics_at(model, x);
  const Vector3 p_L(0.2, -0.1, 0.3), target = k.position(5, p_L) + Vector3(0.1, 0.2, -0.15);
  const double stiffness = 700;
  const Eigen::MatrixXd found = tangent_stiffness(
      model, x,
      [&](const State<double>&, const Kinematics& at, Forces<double>& forces) {
        const Vector3 p = at.position(5, p_L);
        add_point_force(at, 5, p, stiffness * (target - p), forces);
      },
      model.nv);

  const Vector3 p = k.position(5, p_L), F = stiffness * (target - p);
  const Eigen::Matrix3Xd J = point_jacobian(model, k, 5, p), w = rotation_jacobian(model, k, 5);
  Eigen::MatrixXd K = stiffness * J.transpose() * J;
  for (Eigen::Index i = 0; i < 5; ++i)
    for (Eigen::Index j = 0; j < 5; ++j) {
      const Vector3 axis = w.col(std::min(i, j)), arm = J.col(std::max(i, j));
      K(i, j) -= axis.cross(arm).dot(F);
    }
  CHECK((found - K).norm() < 1e-8 * K.norm());
  CHECK((found - stiffness * J.transpose() * J).norm() > 0.05 * K.norm());
}

TEST_CASE("a point spring of one joint with error e and target radius R_K has k r R_K cos e") {
  const double r = 0.4, R_K = 0.7, k = 300, e = 0.5;
  const Model<double> model = one_joint(JointType::revolute, 1);
  const Vector3 target(R_K * std::cos(e), R_K * std::sin(e), 0);
  const Eigen::MatrixXd found = tangent_stiffness(
      model, State<double>(model),
      [&](const State<double>&, const Kinematics& at, Forces<double>& forces) {
        const Vector3 p = at.position(1, {r, 0, 0});
        add_point_force(at, 1, p, k * (target - p), forces);
      },
      model.nv);
  CHECK(found(0, 0) == doctest::Approx(k * r * R_K * std::cos(e)).epsilon(1e-9));
}

TEST_CASE("at zero error it is joint_space, for torsional and linear couplings") {
  const TwoLink arm;
  const Model<double> model = arm.model();
  const State<double> pose = state_of(model, {0.3, 0.8}, {0, 0});
  for (const CouplingSpec& spec :
       {torsional(arm.springs(50, 3), SpringSpace::world),
        torsional(arm.springs(50, 3), SpringSpace::joint), linear(arm.springs(900, 20))}) {
    Coupled system(model, {}, {}, spec, pose);
    system.kvr.set_pose(pose);
    system.coupling->begin_step(system.simulation.kinematics(), 0, 1e-9);
    const Eigen::MatrixXd found = tangent_stiffness(
        model, pose,
        [&](const State<double>& x, const Kinematics& k, Forces<double>& forces) {
          system.coupling->add_forces(x, k, forces);
        },
        model.nv);
    const Kinematics k = kinematics_at(model, pose);
    const Eigen::MatrixXd K = system.coupling->joint_space(k).K;
    CHECK((found - K).norm() < 1e-8 * K.norm());
  }
}

TEST_CASE(
    "springs at point masses with stiffness proportional to mass: all modes have one frequency, "
    "z") {
  // K = (k/m) M, B = (b/m) M: w^2 = k/m and 2 z w = b/m at any pose.
  const Eigen::MatrixXd M = (Eigen::Matrix2d() << 2.2, 0.4, 0.4, 0.3).finished();
  const SpringModes modes = spring_modes(M, 900 * M, 12 * M);
  REQUIRE(modes.size() == 2);
  for (Eigen::Index i = 0; i < 2; ++i) {
    CHECK(modes.omega(i) == doctest::Approx(30));
    CHECK(modes.zeta(i) == doctest::Approx(0.2));
  }
}

TEST_CASE("no mode without stiffness and damping; a mode with damping only has no frequency") {
  const Eigen::MatrixXd M = Eigen::Vector3d(2, 1, 1).asDiagonal();
  const Eigen::MatrixXd K = Eigen::Vector3d(50, 0, 0).asDiagonal();
  const Eigen::MatrixXd B = Eigen::Vector3d(2, 3, 0).asDiagonal();
  const SpringModes modes = spring_modes(M, K, B);
  REQUIRE(modes.size() == 2);
  CHECK(modes.omega(0) == 0);
  CHECK(modes.damping(0, 0) == doctest::Approx(3));
  CHECK(modes.omega(1) == doctest::Approx(5));
  CHECK(modes.zeta(1) == doctest::Approx(0.1));
}
