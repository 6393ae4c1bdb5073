// Equivalent gains: round trips, and the resulting modes.
#include <doctest/doctest.h>

#include "collision/import/robot/robot_model.h"
#include "collision/import/urdf/urdf.h"
#include "coupling/analysis/gains.h"
#include "coupling/analysis/prediction.h"
#include "coupling/laws/spring_damper.h"
#include "tests/coupling/analysis/one_joint.h"
#include "tests/coupling/analysis/two_link.h"
#include "tests/solver/dynamics/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

bool same_gains(const SpringGains& a, const SpringGains& b) {
  return a.k == doctest::Approx(b.k).epsilon(1e-12) && a.b == doctest::Approx(b.b).epsilon(1e-12);
}

struct Posed {
  Model<double> model;
  State<double> x;
  Kinematics k;
  Eigen::MatrixXd M;
  explicit Posed(const Model<double>& m) : model(m), x(m), k(m) {
    const double angles[] = {0.4, -0.7, 0.9, 0.3, -0.8, 0.6};
    for (std::size_t j = 0; j < model.nq; ++j) x.q[j] = angles[j % 6];
    forward_kinematics(model, x, k);
    M = mass_matrix(model, x);
  }
};

Posed puma() {
  return Posed(build_model(read_urdf(TWINARM_SOURCE_DIR "/assets/robots/puma560/puma560.urdf")));
}

}  // namespace

TEST_CASE("every conversion of gains is invertible, at any size, damping and impedance") {
  Random random(12);
  const auto size = [&](double low, double high) {
    return std::pow(10, random.uniform(low, high));
  };
  for (int n = 0; n < 200; ++n) {
    const SpringGains gains{size(-2, 6), size(-3, 4)};
    const double inertia = size(-4, 3), r = size(-2, 1);
    const MujocoImpedance impedance{random.uniform(0.1, 0.99), random.uniform(0.1, 0.999)};
    CHECK(same_gains(gains_of(response_of(gains, inertia), inertia), gains));
    const SpringGains turned = torsional_of_linear(gains, r);
    CHECK(same_gains({turned.k / (r * r), turned.b / (r * r)}, gains));
    const Solref standard = solref_of(gains, inertia, impedance);
    CHECK_FALSE(standard.is_direct());
    CHECK(same_gains(gains_of(standard, inertia, impedance), gains));
    const Solref direct = direct_solref_of(gains, inertia, impedance);
    CHECK(direct.is_direct());
    CHECK(same_gains(gains_of(direct, inertia, impedance), gains));
    for (const auto mode : {Drive::Mode::force, Drive::Mode::acceleration})
      CHECK(same_gains(gains_of(drive_of(gains, inertia, mode), inertia), gains));
  }
}

// mj_makeImpedance of the manual, implemented independently.
TEST_CASE("solref agrees with MuJoCo's manual: w = 1/(timeconst dampratio) at d = dmax") {
  const SpringGains gains = gains_of(Solref{0.02, 0.7}, 3.0);
  const SpringResponse response = response_of(gains, 3.0);
  CHECK(response.omega == doctest::Approx(1 / (0.02 * 0.7)));
  CHECK(response.zeta == doctest::Approx(0.7));
  // d < dmax: a + d (b v + k r) = 0 with b = 2/(dmax T), k = d/(dmax^2 T^2 z^2).
  const double d = 0.6, d_max = 0.9, T = 0.05, z = 1.3, I = 2;
  const SpringGains soft = gains_of(Solref{T, z}, I, {d, d_max});
  CHECK(soft.k == doctest::Approx(I * d * d / (d_max * d_max * T * T * z * z)));
  CHECK(soft.b == doctest::Approx(I * d * 2 / (d_max * T)));
  const SpringGains direct = gains_of(Solref{-400, -30}, I, {d, d_max});
  CHECK(direct.k == doctest::Approx(I * d * 400 * d / (d_max * d_max)));
  CHECK(direct.b == doctest::Approx(I * d * 30 / d_max));
  CHECK(mujoco_static_stiffness(95, {0.95, 0.95}) == doctest::Approx(1900));
  CHECK(min_timeconst(0.002) == 0.004);  // refsafe
}

TEST_CASE("a drive has the spring's gains as a force, and those over the inertia as acceleration") {
  const SpringGains spring{300, 12};
  const Drive force = drive_of(spring, 4, Drive::Mode::force);
  CHECK(force.stiffness == 300);
  CHECK(force.damping == 12);
  const Drive acceleration = drive_of(spring, 4, Drive::Mode::acceleration);
  CHECK(acceleration.stiffness == 75);
  CHECK(acceleration.damping == 3);
  // Three times the inertia: the same drive has three times the stiffness at the same frequency.
  const SpringGains heavier = gains_of(acceleration, 12);
  CHECK(heavier.k == 900);
  CHECK(response_of(heavier, 12).omega == doctest::Approx(response_of(spring, 4).omega));
  CHECK(same_gains(gains_of(force, 12), spring));
}

TEST_CASE("gains by frequency and damping ratio on a joint's inertia give the PUMA that mode") {
  const Posed arm = puma();
  for (Eigen::Index j = 0; j < 6; ++j) {
    const SpringGains gains = gains_of(SpringResponse{70, 0.3}, joint_inertia(arm.M, j));
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(6, 6), B = K;
    K(j, j) = gains.k;
    B(j, j) = gains.b;
    const SpringModes modes = spring_modes(arm.M, K, B);
    REQUIRE(modes.size() == 1);  // no other stiffness
    CHECK(modes.omega(0) == doctest::Approx(70).epsilon(1e-9));
    CHECK(modes.zeta(0) == doctest::Approx(0.3).epsilon(1e-9));
  }
}

TEST_CASE("a spring at a point has the three frequencies of its principal inertias") {
  const Posed arm = puma();
  const Spring spring{"s", 6, {0.05, 0.1, 0.2}, 1000, 8};
  const Eigen::Matrix3Xd J = point_jacobian(arm.model, arm.k, 6, arm.k.position(6, spring.p_L));
  const Eigen::Vector3d masses = principal_inertias(arm.M, J);
  const Coupling::JointSpace space = joint_space_of_points(arm.model, arm.k, {spring});
  const SpringModes modes = spring_modes(arm.M, space.K, space.B);
  REQUIRE(modes.size() == 3);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const SpringResponse response = response_of({spring.k, spring.b}, masses[i]);
    CHECK(modes.omega(2 - i) == doctest::Approx(response.omega).epsilon(1e-9));
    CHECK(modes.zeta(2 - i) == doctest::Approx(response.zeta).epsilon(1e-9));
  }
}

TEST_CASE("one link: a point at r has the apparent inertia I/r^2, and k r^2 is equivalent") {
  const double I = 0.7, r = 0.35, k = 900;
  const Model<double> model = one_joint(JointType::revolute, I);
  const Posed posed(model);
  const Eigen::Matrix3Xd J = point_jacobian(model, posed.k, 1, posed.k.position(1, {r, 0, 0}));
  const Eigen::Vector3d masses = principal_inertias(posed.M, J);
  CHECK(masses[0] == doctest::Approx(I / (r * r)));
  CHECK(std::isinf(masses[1]));
  CHECK(std::isinf(masses[2]));
  const Coupling::JointSpace space =
      joint_space_of_points(model, posed.k, {{"s", 1, {r, 0, 0}, k, 5}});
  CHECK(space.K(0, 0) == doctest::Approx(torsional_of_linear({k, 5}, r).k));
  CHECK(space.B(0, 0) == doctest::Approx(torsional_of_linear({k, 5}, r).b));
}

TEST_CASE(
    "a chain: K_q of springs at elbow and tip is k [[0.45, 0.18], [0.18, 0.09]]; k r^2 is not") {
  const TwoLink arm{1, 1, 0.3, 0.3};
  const Model<double> model = arm.model();
  Kinematics k(model);
  forward_kinematics(model, State<double>(model), k);
  const double stiffness = 1000;
  const std::vector<Spring> springs{{"elbow", 1, {0.3, 0, 0}, stiffness, 0},
                                    {"tip", 2, {0.3, 0, 0}, stiffness, 0}};
  const Eigen::MatrixXd K = joint_space_of_points(model, k, springs).K;
  const Eigen::Matrix2d expected =
      stiffness * (Eigen::Matrix2d() << 0.45, 0.18, 0.18, 0.09).finished();
  CHECK((K - expected).norm() < 1e-9 * expected.norm());
  CHECK(torsional_of_linear({stiffness, 0}, 0.3).k == doctest::Approx(90));  // against 450
}
