// Warnings of inertias, and of shapes if only dynamics is needed. Other warnings: urdf_errors/.
#include <string>

#include "collision/import/robot/robot_model.h"
#include "collision/import/urdf/urdf.h"
#include "tests/collision/import/robot/helpers.h"

namespace twinarm {
namespace {

constexpr RobotFileOptions kStrict{RobotFileOptions::Geometry::required, true};
constexpr RobotFileOptions kDynamics{RobotFileOptions::Geometry::optional, false};

TEST_CASE("a physically impossible inertia is a warning, and an error if strict") {
  const TemporaryFolder folder;
  for (const auto& [ixx, words] :
       {std::pair{"-0.01", "not positive definite: principal moments -0.01, 0.02, 0.025"},
        std::pair{"0", "not positive definite"},
        std::pair{"0.1",
                  "violates the triangle inequality A + B >= C: principal moments 0.02, 0.02"},
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

TEST_CASE("the inertia of a thin plate is valid, although rounding violates A + B = C") {
  const TemporaryFolder folder;
  std::string text = replaced(kGoodArm, "ixx=\"0.01\"", "ixx=\"0.333333\"");
  text = replaced(replaced(text, "0.02\"", "0.333333\""), "0.025", "0.6666665");
  const fs::path file = folder.write("arm.urdf", text);
  CHECK(read_urdf(file, kStrict).warnings.empty());
}

TEST_CASE(
    "dynamics without meshes: missing meshes are one warning, and are kept in the description") {
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
  CHECK(tells(faults, 0,
              "mesh 'no.stl': its file was not found; put it at the path in the robot's file"));
}

TEST_CASE("dynamics without valid shapes: each is a warning and is left out") {
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
