// The KVR of the S-103 against the paper's forward kinematics, its offsets in z-up axes
// (docs/understand/paper.md): each joint's frame is its parent's times its fixed offset times its
// own rotation about z. One unit of the paper is 25 mm here.
#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "collision/import/robot/robot_model.h"
#include "collision/import/urdf/urdf.h"
#include "coupling/target/target_robot.h"
#include "solver/support/diagnostics.h"
#include "tests/coupling/analysis/one_joint.h"
#include "tests/solver/dynamics/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

constexpr double brick = 0.025;  // the paper's unit [m]

const RobotDescription& s103() {
  static const RobotDescription robot =
      read_urdf(TWINARM_SOURCE_DIR "/assets/robots/s103/s103.urdf");
  return robot;
}

class PressingHand final : public OperatorMotion {
 public:
  SteadyHand hand;
  bool pressed = false;
  OperatorSample sample(double t, double toward) const override {
    OperatorSample x = hand.sample(t, toward);
    x.button = pressed;
    return x;
  }
  double duration() const override { return 1; }
  std::string description() const override { return "pressing"; }
};

Eigen::Isometry3d joint(double x, double z, double angle) {
  return Eigen::Translation3d(x * brick, 0, z * brick) * Eigen::AngleAxisd(angle, Vector3::UnitZ());
}

}  // namespace

TEST_CASE("the S-103's KVR agrees with the paper's three matrices at random angles") {
  const Model<double> model = build_model(s103());
  const DrivenJoints driven{{"joint1", "joint2", "joint3"}, "gripper_lift", 0, 0.06};
  Random random(31);
  for (int n = 0; n < 200; ++n) {
    PressingHand hand;
    for (double& angle : hand.hand.angle) angle = random.uniform(-3, 3);
    hand.pressed = n % 2 == 1;
    TargetRobot kvr(model, hand, SteadyHand::mapping(), driven);
    const Kinematics& k = kvr.start().k;

    const auto& q = hand.hand.angle;
    const Eigen::Isometry3d arm1 = joint(0, 10, q[0]);
    const Eigen::Isometry3d arm2 = arm1 * joint(10, 14.6, q[1]);
    const Eigen::Isometry3d quill = arm2 * joint(14, 12.65, q[2]);
    const Eigen::Isometry3d gripper = quill * Eigen::Translation3d(0, 0, hand.pressed ? -0.06 : 0);
    const auto error = [&](const char* link, const Eigen::Isometry3d& X) {
      const int body = model.find_body(link);
      REQUIRE(body > 0);
      const Pose& pose = k.X_WL[static_cast<std::size_t>(body)];
      return (pose.R - X.linear()).norm() + (pose.p - X.translation()).norm();
    };
    CHECK(error("arm1", arm1) < 1e-12);
    CHECK(error("arm2", arm2) < 1e-12);
    CHECK(error("quill", quill) < 1e-12);
    CHECK(error("gripper", gripper) < 1e-12);
  }
}

TEST_CASE("the S-103 with all angles at zero extends along x: 24 units out, 37.25 units up") {
  const Model<double> model = build_model(s103());
  Kinematics k(model);
  forward_kinematics(model, State<double>(model), k);
  const auto quill = static_cast<std::size_t>(model.find_body("quill"));
  CHECK((k.X_WL[quill].p - Vector3(24 * brick, 0, 37.25 * brick)).norm() < 1e-12);
}

TEST_CASE("theta1, theta4, theta6 move the S-103's joints 1, 2, 3 only") {
  const Model<double> model = build_model(s103());
  for (std::size_t j = 0; j < 3; ++j) {
    SteadyHand hand;
    hand.rate[j] = 0.7;
    TargetRobot kvr(model, hand, SteadyHand::mapping(), {{"joint1", "joint2", "joint3"}, "", 0, 0});
    kvr.begin_step(0.5, 0.1);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto body = static_cast<std::size_t>(model.find_joint("joint" + std::to_string(i + 1)));
      CHECK(kvr.end().x.q[model.iq[body]] == doctest::Approx(i == j ? 0.42 : 0.0));
      CHECK(kvr.end().x.qd[model.iv[body]] == doctest::Approx(i == j ? 0.7 : 0.0));
    }
    const auto arm1 = static_cast<std::size_t>(model.find_body("arm1"));
    CHECK(kvr.end().k.w_WL[arm1].z() == doctest::Approx(j == 0 ? 0.7 : 0.0));
  }
}

TEST_CASE("a robot without the driven joints is rejected, all missing names at once") {
  const Model<double> model = build_model(s103());
  const SteadyHand hand;
  try {
    TargetRobot kvr(model, hand, SteadyHand::mapping(), {{"joint1", "elbow"}, "claw", 0, 1});
    FAIL("not refused");
  } catch (const InputError& error) {
    CHECK(error.faults().size() == 2);
    CHECK(std::string(error.what()).find("elbow") != std::string::npos);
    CHECK(std::string(error.what()).find("claw") != std::string::npos);
  }
}
