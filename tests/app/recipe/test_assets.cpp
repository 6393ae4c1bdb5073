// The committed robots agree with their sources.
#include <Eigen/Geometry>
#include <algorithm>

#include "app/recipe/robot_recipe.h"
#include "collision/import/urdf/urdf.h"
#include "tests/collision/import/robot/helpers.h"

namespace twinarm {
namespace {

const fs::path kRobots = fs::path(TWINARM_SOURCE_DIR) / "assets" / "robots";

struct TwoRods {
  const char* name;
  double mass[2], length[2];
};

TEST_CASE("the robots of the findings are two slender rods with revolute joints about z") {
  const TwoRods robots[] = {{"findings_set0", {5, 3}, {0.40, 0.30}},
                            {"findings_set1", {1, 1}, {0.50, 0.50}},
                            {"findings_set2", {10, 6}, {0.35, 0.25}},
                            {"findings_10_14", {5, 3}, {0.25, 0.35}}};
  for (const TwoRods& rods : robots) {
    INFO(rods.name);
    const std::string name = rods.name;
    const RobotDescription robot = read_urdf(kRobots / name / (name + ".urdf"));
    CHECK(robot.name == name);
    CHECK(robot.root == "base");
    REQUIRE(robot.links.size() == 3);
    REQUIRE(robot.joints.size() == 2);
    for (int k = 0; k < 2; ++k) {
      const double m = rods.mass[k], l = rods.length[k];
      const LinkDescription& link = robot.links[k + 1];
      CHECK(link.name == "arm" + std::to_string(k + 1));
      CHECK(link.mass == m);
      CHECK(link.com == Vector3(l / 2, 0, 0));
      // m l^2 / 12, within the rounding of this expression
      CHECK(std::abs(link.inertia(2, 2) - m * l * l / 12) <= 3e-16 * m * l * l / 12);
      CHECK(link.inertia(1, 1) == link.inertia(2, 2));
      CHECK(link.inertia(0, 0) == doctest::Approx(m * 0.01 * 0.01 / 6).epsilon(1e-15));
      CHECK(link.inertia.isDiagonal(0));
      const JointDescription& joint = robot.joints[k];
      CHECK(joint.name == "joint" + std::to_string(k + 1));
      CHECK(joint.type == JointDescription::Type::continuous);
      CHECK(joint.axis == Vector3::UnitZ());
      CHECK(joint.origin.xyz == (k == 0 ? Vector3(0, 0, 0) : Vector3(rods.length[0], 0, 0)));
      CHECK(joint.damping == 0);
      CHECK(joint.friction == 0);
    }
  }
}

TEST_CASE("the committed S-103 is bit-identical to the output of its recipe") {
  const fs::path folder = kRobots / "s103";
  REQUIRE(fs::exists(folder / "robot.toml"));
  const RecipeResult made = read_recipe(folder / "robot.toml");
  check_same(read_urdf(folder / "s103.urdf"), made.robot, 1e-12);
  for (const HullFile& hull : made.hulls) {
    INFO(hull.file.string());
    CHECK(text_of(hull.file) == stl_bytes(hull.hull, hull.scale));
  }
}

TEST_CASE("the S-103 has the paper's joint offsets, link lengths 10 : 14") {
  const RobotDescription robot = read_urdf(kRobots / "s103" / "s103.urdf");
  const Vector3 paper[] = {{0, 0, 10}, {10, 0, 14.6}, {14, 0, 12.65}};
  for (int k = 0; k < 3; ++k) {
    const JointDescription& joint = robot.joints[k];
    CHECK(joint.name == "joint" + std::to_string(k + 1));
    CHECK(joint.type == JointDescription::Type::revolute);
    CHECK(joint.axis == Vector3::UnitZ());
    CHECK((joint.origin.xyz - 0.025 * paper[k]).norm() < 1e-15);
  }
  CHECK(robot.joints[3].type == JointDescription::Type::prismatic);
}

TEST_CASE("the published PUMA 560 loads, and its two impossible inertias are reported") {
  const fs::path file = kRobots / "puma560" / "puma560.urdf";
  const RobotDescription robot = read_urdf(file);
  INFO(listing(robot.warnings));
  double mass = 0;
  for (const LinkDescription& link : robot.links) mass += link.mass;
  CHECK(mass == doctest::Approx(23.45).epsilon(1e-15));
  const auto reported = [&](const std::vector<Diagnostic>& faults, const std::string& words) {
    return std::count_if(faults.begin(), faults.end(), [&](const Diagnostic& fault) {
      return to_string(fault).find(words) != std::string::npos;
    });
  };
  CHECK(reported(robot.warnings, "no rigid body of positive density has it") == 2);
  CHECK(reported(robot.warnings, "link 'link1': its inertia is not positive definite") == 1);
  CHECK(reported(robot.warnings, "link 'link3': its inertia violates the triangle inequality") ==
        1);
  const auto faults = faults_of([&] {
    read_urdf(file, {RobotFileOptions::Geometry::required, true});
  });
  CHECK(faults.size() == 2);
}

}  // namespace
}  // namespace twinarm
