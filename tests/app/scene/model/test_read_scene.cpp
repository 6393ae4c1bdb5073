// Defaults of a scene; errors of other files are reported with its own
// (scene_errors: tests/app/scene/forces).
#include "tests/app/scene/model/helpers.h"

namespace twinarm {
namespace {

TEST_CASE("scene: optional keys have their defaults") {
  const SceneDescription scene =
      scene_of("[[body]]\nname = 'b'\nmass = 1\nshape.sphere.radius = 0.1\n");
  CHECK(scene.gravity == Vector3(0, 0, -9.81));
  CHECK(scene.step == 0.001);
  CHECK(scene.contact == ContactMode::rigid);
  CHECK(scene.detection == Detection::own);
  CHECK(!scene.integrator);
  CHECK(!scene.duration);
  REQUIRE(scene.bodies.size() == 1);
  CHECK(scene.bodies[0].surface.friction == 0.5);
  CHECK(scene.bodies[0].surface.restitution == 0);
  CHECK(scene.bodies[0].is_free());
  CHECK(scene.warnings.empty());
}

TEST_CASE("scene: errors of a robot's file are reported together with those of the scene") {
  const TemporaryFolder folder;
  folder.write("bad.urdf", "<robot name='r'>\n<link name='a'/><link name='a'/>\n</robot>\n");
  const auto scene =
      folder.write("test.toml", "step = 0\n[[robot]]\nname = 'r'\nmodel = 'bad.urdf'\n");
  const std::vector<Diagnostic> faults = faults_of([&] { read_scene(scene); });
  REQUIRE(faults.size() == 2);
  CHECK(faults[0].file == scene.string());
  CHECK(faults[1].file.find("bad.urdf") != std::string::npos);
  CHECK(faults[1].line == 2);
}

TEST_CASE("scene: a missing file is reported") {
  const std::vector<Diagnostic> faults = faults_of([] { read_scene("no/such/scene.toml"); });
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].code == "file.missing");
}

}  // namespace
}  // namespace twinarm
