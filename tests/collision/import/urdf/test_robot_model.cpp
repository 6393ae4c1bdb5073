// From the description to the solver's model.
#include "collision/import/robot/robot_model.h"

#include <cmath>
#include <numbers>
#include <string>

#include "collision/import/robot/robot_check.h"
#include "collision/import/urdf/urdf.h"
#include "solver/dynamics/dynamics.h"
#include "tests/collision/import/robot/helpers.h"

namespace twinarm {
namespace {

constexpr int kRootBody = 1;  // of a model with one robot

LinkDescription heavy(const std::string& name) {
  LinkDescription link;
  link.name = name;
  link.has_inertia = true;
  link.mass = 2;
  link.com = Vector3(0.1, 0.2, 0.3);
  link.inertia = Vector3(0.01, 0.02, 0.025).asDiagonal();
  return link;
}

LinkDescription frame(const std::string& name) {
  LinkDescription link;
  link.name = name;
  return link;
}

JointDescription joint(const std::string& name, JointDescription::Type type,
                       const std::string& parent, const std::string& child) {
  JointDescription j;
  j.name = name, j.type = type, j.parent = parent, j.child = child;
  j.line = 7;
  return j;
}

using Type = JointDescription::Type;

// Every joint type in one chain of massive links, with a massless root.
RobotDescription all_types() {
  RobotDescription robot;
  robot.name = "all";
  robot.file = "/all.urdf";
  robot.root = "l0";
  robot.links.push_back(frame("l0"));
  const Type types[] = {Type::fixed,       Type::revolute, Type::continuous, Type::prismatic,
                        Type::screw,       Type::planar,   Type::floating,   Type::spherical,
                        Type::cylindrical, Type::universal};
  int k = 0;
  for (const Type type : types) {
    JointDescription j = joint("j" + std::to_string(k + 1), type, "l" + std::to_string(k),
                               "l" + std::to_string(k + 1));
    if (type == Type::screw) j.pitch = 0.01;
    j.lower = -1, j.upper = 1;
    j.damping = 0.5, j.friction = 0.25, j.coulomb_plus = 0.25, j.coulomb_minus = 0.75;
    j.armature = 0.125;
    robot.joints.push_back(j);
    robot.links.push_back(heavy("l" + std::to_string(++k)));
  }
  return robot;
}

TEST_CASE("every joint type becomes a joint of the solver with as many velocities") {
  const RobotDescription robot = all_types();
  CHECK(check_robot(robot).faults.empty());
  const Model<double> model = build_model(robot);
  REQUIRE(model.body_count() == 12);
  CHECK(model.body_name[kRootBody] == "l0");
  CHECK(model.joint_name[kRootBody] == "l0_on_world");
  std::size_t nv = 0;
  for (const JointDescription& j : robot.joints) {
    INFO(j.name);
    const int body = model.find_joint(j.name);
    REQUIRE(body > kRootBody);
    const auto i = static_cast<std::size_t>(body);
    CHECK(model.body_name[i] == j.child);
    CHECK(model.iv[i] == nv);
    for (int d = 0; d < j.dofs(); ++d, ++nv) {
      CHECK(model.damping[nv] == 0.5);
      CHECK(model.coulomb_plus[nv] == 0.25);
      CHECK(model.coulomb_minus[nv] == 0.75);
      CHECK(model.armature[nv] == 0.125);
    }
    CHECK(model.pitch[i] == (j.type == Type::screw ? 0.01 / (2 * std::numbers::pi) : 0));
  }
  CHECK(model.nv == nv);
}

TEST_CASE("armature and friction can be ignored") {
  ModelOptions options;
  options.armature = false;
  options.friction = false;
  const Model<double> model = build_model(all_types(), options);
  for (std::size_t d = 0; d < model.nv; ++d) {
    CHECK(model.armature[d] == 0);
    CHECK(model.damping[d] == 0);
    CHECK(model.coulomb_plus[d] == 0);
    CHECK(model.coulomb_minus[d] == 0);
  }
}

TEST_CASE("a floating robot's root has a free joint with a unique name") {
  RobotDescription robot = all_types();
  robot.links[0] = heavy("l0");
  ModelOptions options;
  options.floating = true;
  CHECK(build_model(robot, options).joint_name[kRootBody] == "base");
  robot.joints[0].name = "base";
  robot.joints[1].name = "base_";
  const Model<double> model = build_model(robot, options);
  CHECK(model.joint_name[kRootBody] == "base__");
  CHECK(model.joint[kRootBody] == JointType::free);
  CHECK(model.iv[kRootBody] == 0);
  CHECK(model.nv == build_model(robot).nv + 6);
}

TEST_CASE("a root link may be called world") {
  RobotDescription robot = all_types();
  robot.root = robot.links[0].name = robot.joints[0].parent = "world";
  const Model<double> model = build_model(robot);
  CHECK(model.body_name[kRootBody] == "world");
  CHECK(model.parent[2] == kRootBody);
}

TEST_CASE("a moving link without mass needs a descendant with mass, or an added mass") {
  RobotDescription robot;
  robot.file = "/arm.urdf";
  robot.root = "base";
  robot.links = {frame("base"), frame("yaw"), heavy("arm"), frame("tip")};
  robot.joints = {joint("j1", Type::continuous, "base", "yaw"),
                  joint("j2", Type::continuous, "yaw", "arm"),
                  joint("j3", Type::fixed, "arm", "tip")};
  robot.joints[1].axis = Vector3::UnitZ();
  CHECK_NOTHROW(build_model(robot));
  robot.joints[2].type = Type::continuous;
  const auto faults = faults_of([&] { build_model(robot); });
  INFO(listing(faults));
  CHECK(faults.size() == 1);
  CHECK(tells(faults, 7, "model.no-inertia", "/arm.urdf:7: joint 'j3'"));
  ModelOptions options;
  options.added_masses = {{"tip", Vector3(0, 0.1, 0), 1.0}};
  CHECK_NOTHROW(build_model(robot, options));
  robot.joints[2].armature = 0.1;
  CHECK_NOTHROW(build_model(robot));
  options = {};
  options.armature = false;
  CHECK(faults_of([&] { build_model(robot, options); }).size() == 1);
}

// Two revolute joints on one line with no mass between: only the builder detects it.
TEST_CASE("errors of the solver's builder are reported with file and line of the joint") {
  RobotDescription robot;
  robot.file = "/arm.urdf";
  robot.root = "base";
  robot.links = {frame("base"), frame("hub"), heavy("arm")};
  robot.joints = {joint("j1", Type::continuous, "base", "hub"),
                  joint("j2", Type::continuous, "hub", "arm")};
  const auto faults = faults_of([&] { build_model(robot); });
  INFO(listing(faults));
  CHECK(tells(faults, 7, "model.no-inertia", "/arm.urdf:7: joint 'j1'"));
  robot.joints[1].origin.xyz = {0, 0.1, 0};
  CHECK_NOTHROW(build_model(robot));
}

TEST_CASE("a scaled mass scales the inertia, and keeps the centre of mass") {
  ModelOptions options;
  options.mass_scale["l2"] = 3;
  RobotDescription thrice = all_types();
  thrice.links[2].mass *= 3;
  thrice.links[2].inertia *= 3;
  const Model<double> scaled = build_model(all_types(), options), model = build_model(thrice);
  const State<double> x(model);
  const Eigen::MatrixXd M = mass_matrix(scaled, x);
  CHECK(M == mass_matrix(model, x));
  CHECK(M != mass_matrix(build_model(all_types()), x));
}

TEST_CASE("numbers of a description that are not finite are rejected") {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    RobotDescription robot = all_types();
    robot.links[1].mass = bad;
    robot.links[2].com.x() = bad;
    robot.links[3].inertia(1, 2) = bad;
    robot.joints[1].mimic = {"j3", bad, 0};
    robot.joints[3].mimic = {"j3", 1, bad};
    const auto faults = check_robot(robot).faults;
    INFO(listing(faults));
    CHECK(faults.size() == 5);
    for (const Diagnostic& fault : faults) {
      CHECK(fault.problem.find("finite") != std::string::npos);
      CHECK(fault.fix.find("give finite numbers") == 0);
    }
  }
}

TEST_CASE("a robot without mass cannot float") {
  RobotDescription robot;
  robot.root = "base";
  robot.links = {frame("base")};
  ModelOptions options;
  options.floating = true;
  CHECK(faults_of([&] { build_model(robot, options); }).size() == 1);
}

TEST_CASE("a mass for a link that does not exist is rejected") {
  ModelOptions options;
  options.mass_scale["nobody"] = 2;
  options.added_masses = {{"none", Vector3::Zero(), 1.0}};
  const auto faults = faults_of([&] { build_model(all_types(), options); });
  CHECK(faults.size() == 2);
  CHECK(tells(faults, 0, "'nobody' is not a link"));
  CHECK(tells(faults, 0, "'none' is not a link"));
}

TEST_CASE("mimic joints have their velocities, chains are resolved to the first mimicked joint") {
  RobotDescription robot;
  robot.root = "l0";
  robot.links = {frame("l0"), heavy("l1"), heavy("l2"), heavy("l3")};
  robot.joints = {joint("a", Type::continuous, "l0", "l1"),
                  joint("b", Type::continuous, "l1", "l2"),
                  joint("c", Type::prismatic, "l2", "l3")};
  robot.joints[1].mimic = {"a", 2, 0.5};
  robot.joints[2].mimic = {"b", -3, 0.25};
  const Model<double> model = build_model(robot);
  REQUIRE(model.mimics.size() == 2);
  for (const Mimic& mimic : model.mimics) {
    CHECK(mimic.leader == 0);
    REQUIRE((mimic.follower == 1 || mimic.follower == 2));
    // c = -3 b + 0.25 = -3 (2 a + 0.5) + 0.25
    CHECK(mimic.ratio == (mimic.follower == 1 ? 2 : -6));
    CHECK(mimic.offset == (mimic.follower == 1 ? 0.5 : -1.25));
  }
}

}  // namespace
}  // namespace twinarm
