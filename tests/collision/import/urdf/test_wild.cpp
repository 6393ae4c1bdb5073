// Files in the styles of users (tests/collision/import/urdf/wild). Oracle: an independent reader in
// another language, with its counts and sums in wild/expected.txt (wild/README.md).
#include <iomanip>
#include <map>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "collision/import/robot/robot_check.h"
#include "collision/import/urdf/urdf.h"
#include "tests/collision/import/robot/helpers.h"

namespace twinarm {
namespace {

const fs::path kWild = fs::path(TWINARM_SOURCE_DIR) / "tests/collision/import/urdf/wild";
constexpr RobotFileOptions kWithoutMeshes{RobotFileOptions::Geometry::optional, false};

struct Expected {
  std::string name;
  int links, without_inertial, joints, fixed, mimic, listed, dofs;
  double mass;
  int meshes;
  std::string root;
  Vector3 com;
  Vector3 moments;   // Ixx, Iyy, Izz about the world's origin at q = 0
  Vector3 products;  // Ixy, Ixz, Iyz: matrix entries
  std::string frame;
  Vector3 p_W;
};

std::vector<Expected> all_expected() {
  std::vector<Expected> all;
  std::istringstream file(text_of(kWild / "expected.txt"));
  for (std::string line; std::getline(file, line);) {
    if (line[0] == '#') continue;
    std::istringstream in(line);
    Expected& e = all.emplace_back();
    const auto read = [&](Vector3& v) { in >> v.x() >> v.y() >> v.z(); };
    in >> std::quoted(e.name) >> e.links >> e.without_inertial >> e.joints >> e.fixed >> e.mimic >>
        e.listed >> e.dofs >> e.mass >> e.meshes >> std::quoted(e.root);
    read(e.com), read(e.moments), read(e.products);
    in >> std::quoted(e.frame);
    read(e.p_W);
    REQUIRE(in);
  }
  REQUIRE(all.size() == 4);
  return all;
}

RobotDescription wild(const std::string& name, const RobotFileOptions& options = kWithoutMeshes) {
  return read_urdf(kWild / (name + ".urdf"), options);
}

std::map<std::string, Pose> poses_at_zero(const RobotDescription& robot) {
  std::map<std::string, Pose> X_WL;
  X_WL[robot.root] = {};
  for (const std::size_t j : joints_from_root(robot))
    X_WL[robot.joints[j].child] = X_WL.at(robot.joints[j].parent) * robot.joints[j].X_PJ();
  return X_WL;
}

// Mass, first moment and inertia about the world's origin.
struct Sums {
  double mass = 0;
  Vector3 moment = Vector3::Zero();
  Matrix3 inertia = Matrix3::Zero();
};

Sums sums(const RobotDescription& robot) {
  const auto X_WL = poses_at_zero(robot);
  Sums s;
  for (const LinkDescription& link : robot.links) {
    const Pose& X = X_WL.at(link.name);
    const Vector3 c = X * link.com;
    s.mass += link.mass;
    s.moment += link.mass * c;
    s.inertia += X.R * link.inertia * X.R.transpose() +
                 link.mass * (c.squaredNorm() * Matrix3::Identity() - c * c.transpose());
  }
  return s;
}

TEST_CASE("files in the wild: links, joints and meshes agree with another reader") {
  for (const Expected& e : all_expected()) {
    INFO(e.name);
    const RobotDescription robot = wild(e.name);
    CHECK(robot.root == e.root);
    CHECK(static_cast<int>(robot.links.size()) == e.links);
    CHECK(static_cast<int>(robot.joints.size()) == e.joints);
    int bare = 0, fixed = 0, mimic = 0, listed = 0, dofs = 0, meshes = 0;
    for (const LinkDescription& link : robot.links) {
      bare += !link.has_inertia;
      for (const auto& part : link.visuals)
        meshes += std::holds_alternative<MeshGeometry>(part.geometry);
      for (const auto& part : link.collisions)
        meshes += std::holds_alternative<MeshGeometry>(part.geometry);
    }
    for (const JointDescription& joint : robot.joints) {
      fixed += joint.type == JointDescription::Type::fixed;
      mimic += joint.mimic.has_value();
      if (joint.mimic || joint.dofs() == 0) continue;
      ++listed;
      dofs += joint.dofs();
    }
    CHECK(bare == e.without_inertial);
    CHECK(fixed == e.fixed);
    CHECK(mimic == e.mimic);
    CHECK(listed == e.listed);
    CHECK(dofs == e.dofs);
    CHECK(meshes == e.meshes);
  }
}

TEST_CASE("files in the wild: mass, centre, inertia and a frame agree with another reader") {
  for (const Expected& e : all_expected()) {
    INFO(e.name);
    const RobotDescription robot = wild(e.name);
    const Sums s = sums(robot);
    CHECK(s.mass == doctest::Approx(e.mass).epsilon(1e-14));
    CHECK((s.moment / s.mass - e.com).norm() < 1e-13);
    Matrix3 expected = e.moments.asDiagonal();
    expected(0, 1) = expected(1, 0) = e.products[0];
    expected(0, 2) = expected(2, 0) = e.products[1];
    expected(1, 2) = expected(2, 1) = e.products[2];
    CHECK((s.inertia - expected).norm() < 1e-13 * expected.norm());
    CHECK((poses_at_zero(robot).at(e.frame).p - e.p_W).norm() < 1e-13);
  }
}

TEST_CASE("files in the wild: elements without effect are reported once per kind") {
  const std::map<std::string, std::vector<std::string>> kinds = {
      {"cad_welder", {"mesh file", "<calibration>", "<safety_controller>", "<axis>"}},
      {"xacro_arm_gripper",
       {"mesh file", "<transmission>", "<gazebo>", "<ros2_control>", "<safety_controller>",
        "<axis>"}},
      {"humanoid_pilar", {"mesh file", "<calibration>", "<axis> has no effect on a floating"}},
      {"mobile_carrito",
       {"mesh file", "texture file", "<contact>", "<sensor>", "<gazebo>", "'rpy' of <axis>",
        "its axis has length 3"}}};
  for (const auto& [name, expected] : kinds) {
    const RobotDescription robot = wild(name);
    INFO(listing(robot.warnings));
    for (const std::string& words : expected) {
      int found = 0;
      for (const Diagnostic& warning : robot.warnings)
        found += warning.line > 0 && warning.problem.find(words) != std::string::npos;
      CHECK_MESSAGE(found == 1, words);
    }
    CHECK(robot.warnings.size() == expected.size());
  }
}

TEST_CASE("files in the wild: bit-identical when written and read again") {
  const TemporaryFolder folder;
  for (const Expected& e : all_expected()) {
    const RobotDescription robot = wild(e.name);
    write_urdf(robot, folder.path() / "out.urdf");
    check_same(read_urdf(folder.path() / "out.urdf", kWithoutMeshes), robot, 0.0);
  }
}

TEST_CASE("files in the wild: a missing mesh is rejected if it is needed") {
  for (const Expected& e : all_expected()) {
    const auto faults = faults_of([&] { wild(e.name, {}); });
    CHECK(static_cast<int>(faults.size()) == e.meshes);
  }
}

TEST_CASE("files in the wild: all errors of a student's first file are reported at once") {
  const auto lines_of = [](const std::vector<Diagnostic>& faults) {
    std::vector<int> lines;
    for (const Diagnostic& fault : faults) lines.push_back(fault.line);
    return lines;
  };
  const std::string name = "student_two_link";
  const RobotFileOptions all{RobotFileOptions::Geometry::required, true};
  const auto faults = faults_of([&] { wild(name, all); });
  INFO(listing(faults));
  CHECK(lines_of(faults) ==
        std::vector<int>{7, 14, 22, 27, 32, 36, 47, 48, 50, 56, 56, 57, 59, 62});
  CHECK(tells(faults, 27, "urdf.number", "'0,2'"));
  CHECK(tells(faults, 36, "robot.two-roots", "'table'"));
  CHECK(lines_of(faults_of([&] { wild(name); })) ==
        std::vector<int>{14, 27, 36, 47, 48, 50, 56, 56, 57, 59, 62});
}

}  // namespace
}  // namespace twinarm
