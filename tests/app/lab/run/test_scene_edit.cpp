// Scenes of robot files, and scenes edited in the lab, against closed forms.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "app/lab/run/lab_scene.h"
#include "tests/app/lab/run/helpers.h"

namespace twinarm {
namespace {

constexpr double kPi = std::numbers::pi;
// A rod of 1 kg, 1 m long, about its end: inertia about the hinge 0.1 + 0.25 kg m^2.
const std::string kHingedRod = test_data("data/rod.urdf");
constexpr double kInertia = 0.35, kMoment = 9.81 * 0.5;

LabScene scene_of_rod(const TemporaryFolder& folder) {
  const std::filesystem::path file = folder.write("rod.urdf", kHingedRod);
  SimulateOptions options;
  options.robot.model = folder.path() / "rod_lab.toml";
  options.scene = scene_of_robot(file, true);
  return LabScene(options);
}

// Position of the hinge, or of a body along z, after so many steps of 1 ms.
double value_after(const LabScene& scene, const std::vector<Change>& changes, long steps,
                   const std::string& joint = "hinge", std::size_t component = 0) {
  OperatorInput hand;
  LabRun run(scene.plan(changes), hand, nullptr);
  for (long n = 0; n < steps; ++n) REQUIRE(run.step());
  const Model<double>& model = run.prepared().input.robot.model;
  const auto body = static_cast<std::size_t>(model.find_joint(joint));
  return run.view().simulation().state().q[model.iq[body] + component];
}

std::shared_ptr<const LabScene> edited(const LabScene& scene, const std::string& what,
                                       const std::string& name = "",
                                       const std::vector<Change>& changes = {}) {
  return scene.edited(changes, {what, name});
}

TEST_CASE("scene of a robot file: moves as the robot alone, bit for bit") {
  const TemporaryFolder folder;
  const LabScene scene = scene_of_rod(folder);
  SimulateOptions alone;
  alone.robot.model = folder.path() / "rod.urdf";
  alone.robot.state = folder.write("state.json", R"({"q": {"hinge": 1}})");
  CHECK(value_after(scene, {{"robot[0].q.hinge", "1"}}, 500) ==
        value_after(LabScene(alone), {}, 500));
  CHECK(scene.text().find("model = \"rod.urdf\"") != std::string::npos);
}

TEST_CASE("scene keys torque and damping: constant acceleration, exponential decay") {
  const TemporaryFolder folder;
  const LabScene scene = scene_of_rod(folder);
  const std::vector<Change> pushed{{"gravity[2]", "0"}, {"robot.torque.hinge", "2"}};
  CHECK(value_after(scene, pushed, 1000) == doctest::Approx(0.5 * 2 / kInertia).epsilon(0.002));
  const std::vector<Change> braked{
      {"gravity[2]", "0"}, {"robot[0].qd.hinge", "1"}, {"robot[0].damping.hinge", "0.7"}};
  CHECK(value_after(scene, braked, 1000) ==
        doctest::Approx(kInertia / 0.7 * (1 - std::exp(-0.7 / kInertia))).epsilon(0.002));
  CHECK_THROWS_WITH(scene.plan({{"robot[0].damping.hinge", "-1"}}), doctest::Contains(">= 0"));
  CHECK_THROWS_WITH(scene.plan({{"robot[0].torque.hing", "1"}}), doctest::Contains("'hinge'"));
}

TEST_CASE("edit: joint springs hold a horizontal rod with the sag of their stiffness") {
  const TemporaryFolder folder;
  const LabScene scene = scene_of_rod(folder);
  const std::shared_ptr<const LabScene> held =
      edited(scene, "joint-springs", "", {{"robot[0].q.hinge", std::to_string(kPi / 2)}});
  const double k = kInertia * 30 * 30, q = value_after(*held, {}, 3000);
  CHECK(k * (kPi / 2 - q) == doctest::Approx(kMoment * std::sin(q)).epsilon(0.005));
}

TEST_CASE("edit: a link spring acts at the centre of mass with the robot's mass") {
  const TemporaryFolder folder;
  const std::shared_ptr<const LabScene> held = edited(scene_of_rod(folder), "link-spring", "rod");
  const auto plan = held->plan();
  const CouplingDescription& spring = plan->prepared.input.scene->description.couplings.at(0);
  CHECK(spring.point == Vector3(0, 0, -0.5));
  CHECK(spring.stiffness == doctest::Approx(900));
  CHECK(spring.damping == doctest::Approx(60));
  CHECK_THROWS_WITH(edited(*held, "link-spring", "rot"), doctest::Contains("no link"));
}

TEST_CASE("edit: a box dropped on the floor below everything comes to rest on it") {
  const TemporaryFolder folder;
  const std::shared_ptr<const LabScene> floored = edited(scene_of_rod(folder), "floor");
  CHECK_THROWS_WITH(edited(*floored, "floor"), doctest::Contains("already"));
  const std::shared_ptr<const LabScene> boxed = edited(*floored, "box");
  const auto plan = boxed->plan();
  const SceneDescription& scene = plan->prepared.input.scene->description;
  const double floor = std::get<HalfSpace>(scene.bodies.at(0).shape).offset;
  const double edge = std::get<Box>(scene.bodies.at(1).shape).size.z();
  CHECK(floor <= 0);
  CHECK(value_after(*boxed, {}, 3000, "box", 2) == doctest::Approx(floor + edge / 2).epsilon(0.01));
}

TEST_CASE("edit: a removed body takes its pairs along, and an unknown one is named") {
  const LabScene scene = lab_scene(kFreeBox);
  const std::shared_ptr<const LabScene> two = edited(scene, "sphere");
  const std::string body = two->plan()->prepared.input.scene->description.bodies.back().name;
  CHECK(two->text().find(body) != std::string::npos);
  const std::string left = edited(*two, "remove", body)->text();
  CHECK(left.find(body) == std::string::npos);
  CHECK(left.find("\"box\"") != std::string::npos);
  CHECK_THROWS_WITH(edited(scene, "remove", "sfere"), doctest::Contains("no body 'sfere'"));
  CHECK_THROWS_WITH(edited(scene, "joint-springs"), doctest::Contains("no robot"));
}

}  // namespace
}  // namespace twinarm
