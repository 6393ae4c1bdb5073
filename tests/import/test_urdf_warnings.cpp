// What is read although it is suspicious, or has no effect here: a warning, with its line.
#include <string>

#include "collision/import/robot/mesh_geometry.h"
#include "collision/import/urdf/urdf.h"
#include "tests/import/helpers.h"

namespace twinarm {
namespace {

constexpr UrdfOptions kStrict{UrdfOptions::Geometry::required, true};
constexpr UrdfOptions kDynamics{UrdfOptions::Geometry::optional, false};

struct Odd {
  const char* from;
  const char* to;
  int line;
  const char* words;  // in the warning
};

const Odd kOddLines[] = {
    {"</robot>", "<gazebo/><gazebo reference=\"arm1\"><mu1>1</mu1></gazebo></robot>", 20,
     "<gazebo> has no effect here (the first of 2)"},
    {"</robot>", "<transmission name=\"t\"><type>x</type></transmission></robot>", 20,
     "<transmission> has no effect"},
    {"</robot>", "<ros2_control name=\"t\"/></robot>", 20, "<ros2_control> has no effect"},
    {"</robot>", "<sensor name=\"t\"/></robot>", 20, "<sensor> has no effect"},
    {"<axis", "<safety_controller k_velocity=\"1\"/><axis", 16,
     "joint 'joint1': <safety_controller> has no effect"},
    {"<axis", "<calibration rising=\"0\"/><axis", 16, "<calibration> has no effect"},
    {"<axis", "<dampening/><axis", 16, "<dampening> in <joint> is not known"},
    {"</robot>", "<robots/></robot>", 20, "<robots> in <robot> is not known"},
    {"<inertial>", "<inertial><com/>", 4, "link 'arm1': <com> in <inertial> is not known"},
    {"lower=\"-1\"", "lower=\"-1\" middle=\"0\"", 17, "attribute 'middle' of <limit>"},
    {"<axis", "<twinarm armatur=\"1\"/><axis", 16, "attribute 'armatur' of <twinarm>"},
    {"name=\"arm\"", "name=\"arm\" vendor=\"x\" xmlns:x=\"y\" version=\"1.0\"", 1, "'vendor'"},
    {"lower=\"-1\" upper=\"1.5\"", "", 17, "neither lower nor upper"},
    {"effort=\"10\"", "", 17, "lacks effort or velocity"},
    {"type=\"revolute\"", "type=\"continuous\"", 17,
     "the range in <limit> has no effect on a continuous joint"},
    {"<axis", "<twinarm pitch=\"1\"/><axis", 16, "the pitch has no effect on a revolute joint"},
    {"<axis", "<twinarm type=\"screw\" pitch=\"0\"/><axis", 16, "its pitch is 0"},
    {"xyz=\"0 0 1\"", "xyz=\"0 0 2\"", 16, "its axis has length 2"},
    {"</geometry>", "</geometry><material name=\"blue\"/>", 10, "'blue' is not defined"},
    {"</geometry>", "</geometry><material name=\"b\"><color rgba=\"255 0 0 1\"/></material>", 10,
     "'255 0 0 1' lies outside [0, 1] and is clamped"},
    {"</geometry>", "</geometry><material name=\"b\"><color rgba=\"red\"/></material>", 10,
     "'red'"},
    {"</geometry>", "</geometry><material name=\"b\"><texture filename=\"x\"/></material>", 10,
     "texture file 'x' does not exist"},
    {"</geometry>",
     "</geometry><material name=\"b\"><color rgba=\"1 0 0 1\"/><texture/></material>", 10,
     "its <texture> has no 'filename'; give filename="},
    {"</robot>",
     "<material name=\"m\"><color rgba=\"1 0 0 1\"/></material>"
     "<material name=\"m\"><color rgba=\"0 1 0 1\"/></material></robot>",
     20, "material 'm': it is defined twice; the first counts"},
    {"ixx=\"0.01\" ixy=\"0\" ixz=\"0\" iyy=\"0.02\" iyz=\"0\" izz=\"0.025\"",
     "ixx=\"0\" ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" izz=\"0\"", 7,
     "link 'arm1': its inertia is zero: a point mass of 2 kg"},
    {"xyz=\"0.2 0 0\"", "xyz=\"0.2 0 0\" rpy=\"0 90 0\"", 5,
     "rpy = '0 90 0' is more than a full turn"},
    {"value=\"2\"", "value=\"0\"", 6, "link 'arm1': its mass is 0, but its inertia is not"},
};

TEST_CASE("what is odd in a URDF gives one warning with file, line and remedy, and is read") {
  const TemporaryFolder folder;
  for (const Odd& odd : kOddLines) {
    INFO(odd.from, " -> ", odd.to);
    const fs::path file = folder.write("arm.urdf", replaced(kGoodArm, odd.from, odd.to));
    const RobotDescription robot = read_urdf(file);
    INFO(listing(robot.warnings));
    CHECK(tells(robot.warnings, odd.line, odd.words));
    CHECK(robot.warnings.size() == 1);
    for (const Fault& warning : robot.warnings) {
      CHECK(warning.file == file.string());
      CHECK(!warning.remedy.empty());
    }
  }
}

TEST_CASE("a good robot has no warning") {
  const TemporaryFolder folder;
  CHECK(read_urdf(folder.write("arm.urdf", kGoodArm)).warnings.empty());
}

TEST_CASE("a fixed joint may carry axis, limit and dynamics, as CAD programs write them") {
  const TemporaryFolder folder;
  const std::string text = replaced(kGoodArm, "type=\"revolute\"", "type=\"fixed\"");
  const RobotDescription robot = read_urdf(
      folder.write("arm.urdf", replaced(text, "axis xyz=\"0 0 1\"", "axis xyz=\"0 0 0\"")));
  INFO(listing(robot.warnings));
  CHECK(robot.warnings.size() == 3);
  CHECK(tells(robot.warnings, 16, "<axis> has no effect on a fixed joint"));
  CHECK(tells(robot.warnings, 17, "the range in <limit> has no effect on a fixed"));
  CHECK(tells(robot.warnings, 18, "<dynamics> has no effect on a fixed joint"));
}

TEST_CASE("an inertia that no rigid body has is named and read; where strict, it is refused") {
  const TemporaryFolder folder;
  for (const auto& [ixx, words] :
       {std::pair{"-0.01", "not positive definite: principal moments -0.01, 0.02, 0.025"},
        std::pair{"0", "not positive definite"},
        std::pair{"0.1", "breaks the triangle inequality A + B >= C: principal moments 0.02, 0.02"},
        std::pair{"0.1", "no rigid body of positive density has it"}}) {
    std::string text = replaced(kGoodArm, "ixx=\"0.01\"", std::string("ixx=\"") + ixx + "\"");
    if (std::string(ixx) == "0.1") text = replaced(text, "0.025", "0.02");
    const fs::path file = folder.write("arm.urdf", text);
    const RobotDescription robot = read_urdf(file);
    INFO(listing(robot.warnings));
    CHECK(robot.warnings.size() == 1);
    CHECK(tells(robot.warnings, 7, std::string("link 'arm1': ")));
    CHECK(tells(robot.warnings, 7, words));
    const auto faults = faults_of([&] { read_urdf(file, kStrict); });
    CHECK(faults.size() == 1);
    CHECK(tells(faults, 7, words));
  }
}

TEST_CASE("a thin rod is told as such in whatever axes its inertia is given") {
  // (0, 1, 1) times 0.02, turned: rounding makes the zero a small number of either sign.
  const TemporaryFolder folder;
  for (const char* rpy : {"0 0 0", "0.1 0.2 0.3", "1.5707963267948966 0 0", "-1 2 3"}) {
    std::string text = replaced(kGoodArm, "ixx=\"0.01\"", "ixx=\"0\"");
    text = replaced(replaced(text, "0.025", "0.02"), "xyz=\"0.2 0 0\"",
                    std::string("xyz=\"0.2 0 0\" rpy=\"") + rpy + "\"");
    const RobotDescription robot = read_urdf(folder.write("arm.urdf", text));
    CHECK(robot.warnings.size() == 1);
    CHECK(tells(robot.warnings, 7, "link 'arm1': its inertia is not positive definite"));
  }
}

TEST_CASE("the inertia of a thin plate is that of a body, though rounding breaks A + B = C") {
  const TemporaryFolder folder;
  std::string text = replaced(kGoodArm, "ixx=\"0.01\"", "ixx=\"0.333333\"");
  text = replaced(replaced(text, "0.02\"", "0.333333\""), "0.025", "0.6666665");
  const fs::path file = folder.write("arm.urdf", text);
  CHECK(read_urdf(file, kStrict).warnings.empty());
}

TEST_CASE("frames without mass are links, also on moving joints and with <inertial> of zeros") {
  const TemporaryFolder folder;
  const std::string text = R"(<robot name="arm">
<link name="base"/>
<link name="yaw"/>
<link name="pitch"><inertial><mass value="0"/><inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial></link>
<link name="arm"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
<link name="tip"/>
<joint name="j1" type="continuous"><parent link="base"/><child link="yaw"/></joint>
<joint name="j2" type="continuous"><parent link="yaw"/><child link="pitch"/></joint>
<joint name="j3" type="continuous"><parent link="pitch"/><child link="arm"/></joint>
<joint name="j4" type="fixed"><parent link="arm"/><child link="tip"/></joint>
</robot>)";
  CHECK(read_urdf(folder.write("a.urdf", text)).warnings.empty());
  SUBCASE("but a joint that carries no mass at all is told") {
    const auto robot = read_urdf(folder.write("b.urdf", replaced(text, "fixed", "continuous")));
    CHECK(robot.warnings.size() == 1);
    CHECK(tells(robot.warnings, 10,
                "joint 'j4': neither link 'tip' nor anything outward of it has mass"));
  }
  SUBCASE("unless it has a rotor") {
    const std::string rotor = "<twinarm armature=\"0.1\"/><parent link=\"arm\"/>";
    std::string moving = replaced(text, "fixed", "continuous");
    moving = replaced(moving, "<parent link=\"arm\"/>", rotor);
    CHECK(read_urdf(folder.write("c.urdf", moving)).warnings.empty());
  }
}

TEST_CASE("dynamics does without the meshes: they are one warning, and stay in the description") {
  const TemporaryFolder folder;
  const std::string meshes =
      "<mesh filename=\"no.stl\" scale=\"1 2 3\"/></geometry></visual><visual name=\"v\"><geometry>"
      "<mesh filename=\"package://p/no.stl\"/></geometry></visual><collision><geometry>"
      "<mesh filename=\"http://x/no.stl\"/></geometry></collision><visual><geometry>"
      "<box size=\"1 1 1\"/>";
  const fs::path file =
      folder.write("arm.urdf", replaced(kGoodArm, "<box size=\"0.4 0.1 0.1\"/>", meshes));
  CHECK(faults_of([&] { read_urdf(file); }).size() == 3);
  const RobotDescription robot = read_urdf(file, kDynamics);
  INFO(listing(robot.warnings));
  CHECK(robot.warnings.size() == 1);
  CHECK(tells(robot.warnings, 10, "mesh file 'no.stl' does not exist (the first of 3)"));
  REQUIRE(robot.links[1].visuals.size() == 3);
  REQUIRE(robot.links[1].collisions.size() == 1);
  const auto& mesh = std::get<MeshGeometry>(robot.links[1].visuals[0].geometry);
  CHECK(mesh.file.empty());
  CHECK(mesh.name == "no.stl");
  CHECK(mesh.scale == Vector3(1, 2, 3));
  const auto faults = faults_of([&] { load_mesh(mesh); });
  CHECK(tells(faults, 0, "mesh 'no.stl': its file was not found; put it where the robot's file"));
}

TEST_CASE("dynamics does without shapes that cannot be read: each is a warning and is left out") {
  const TemporaryFolder folder;
  for (const char* shape : {"<cone/>", "<sphere radius=\"0\"/>", "<box size=\"1 x 1\"/>", ""}) {
    INFO(shape);
    const fs::path file =
        folder.write("arm.urdf", replaced(kGoodArm, "<box size=\"0.4 0.1 0.1\"/>", shape));
    CHECK(faults_of([&] { read_urdf(file); }).size() == 1);
    const RobotDescription robot = read_urdf(file, kDynamics);
    CHECK(robot.warnings.size() == 1);
    CHECK(robot.warnings[0].line == 10);
    CHECK(robot.links[1].visuals.empty());
  }
}

}  // namespace
}  // namespace twinarm
