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

TEST_CASE("scene: copies of a body stand in a grid, with names in the order of their places") {
  const auto wall = [](const std::string& more) {
    return scene_of(
        "[[body]]\nname = 'brick'\nmass = 1\nshape.sphere.radius = 0.1\nposition = [1, 2, 3]\n"
        "copies = { count = [2, 1, 3], spacing = [0.5, 7, 0.25]" +
        more + " }\n");
  };
  const SceneDescription scene = wall("");
  REQUIRE(scene.bodies.size() == 6);
  CHECK(scene.bodies[0].name == "brick1");
  CHECK(scene.bodies[0].X_WB.p == Vector3(1, 2, 3));
  CHECK(scene.bodies[1].X_WB.p == Vector3(1.5, 2, 3));
  CHECK(scene.bodies[5].name == "brick6");
  CHECK(scene.bodies[5].X_WB.p == Vector3(1.5, 2, 3.5));
  CHECK(scene.bodies[5].mass == 1);

  const SceneDescription scattered = wall(", scatter = 0.01"), again = wall(", scatter = 0.01");
  double largest = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const Vector3 shift = scattered.bodies[i].X_WB.p - scene.bodies[i].X_WB.p;
    CHECK(shift.cwiseAbs().maxCoeff() <= 0.01);
    CHECK(scattered.bodies[i].X_WB.p == again.bodies[i].X_WB.p);
    largest = std::max(largest, shift.norm());
  }
  CHECK(largest > 0.003);
}

TEST_CASE("scene: copies are counted in whole numbers, up to 10000 bodies, and named apart") {
  const auto codes = [](const std::string& text) {
    std::vector<std::string> found;
    for (const Diagnostic& fault : faults_of([&] { scene_of(text); }))
      found.emplace_back(fault.code);
    return found;
  };
  const std::string body = "[[body]]\nname = 'b'\nmass = 1\nshape.sphere.radius = 0.1\n";
  for (const char* count : {"[0, 1, 1]", "[1.5, 1, 1]", "[101, 100, 1]", "[1e200, 1e200, 1]"}) {
    CAPTURE(count);
    CHECK(codes(body + "copies = { count = " + count + ", spacing = [1, 1, 1] }\n") ==
          std::vector<std::string>{"scene.range"});
  }
  const std::string most = body + "copies = { count = [100, 100, 1], spacing = [1, 1, 1] }\n";
  CHECK(codes(most) == std::vector<std::string>{});
  CHECK(codes(most + "[[body]]\nname = 'c'\nmass = 1\nshape.sphere.radius = 0.1\n"
                     "copies = { count = [2, 1, 1], spacing = [1, 1, 1] }\n") ==
        std::vector<std::string>{"scene.range"});
  CHECK(codes(body + "copies = { count = [2, 1, 1] }\n") ==
        std::vector<std::string>{"scene.missing"});
  CHECK(codes(body + "copies = { count = [2, 1, 1], spacing = [1, 1, 1] }\n[[body]]\nname = 'b1'\n"
                     "mass = 1\nshape.sphere.radius = 0.1\n") ==
        std::vector<std::string>{"scene.name-taken"});
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
