// Constraint forces that the equations of motion do not determine are marked.
#include <doctest/doctest.h>

#include <map>

#include "app/inspect/report/inspect_output.h"
#include "app/run/simulate_input.h"
#include "tests/app/scene/model/helpers.h"

using namespace twinarm;

namespace {

// By the name of the force; contacts after one step of the scene.
std::map<std::string, bool> uniqueness(const std::string& text) {
  const TemporaryFolder folder;
  SimulateOptions options;
  options.duration = 1;
  options.robot.model = folder.write("scene.toml", text);
  SimulatePlan plan = prepare_simulation(options);
  SceneInspector inspector(plan.input, 1e-3);
  const auto look = [&] {
    std::map<std::string, bool> unique;
    for (const AppliedForce& actor : inspector.look().actors)
      if (actor.is_interaction) unique[actor.source] = actor.is_unique;
    return unique;
  };
  const auto unique = look();
  CHECK(look() == unique);  // of the next instant, without the forces of this one
  return unique;
}

const std::string kFloor = R"(
[[body]]
name = "floor"
fixed = true
shape = { halfspace = { normal = [0, 0, 1], offset = 0 } }
)";

std::string body(const std::string& shape, double z, const std::string& more = "") {
  return kFloor + "[[body]]\nname = \"b\"\nmass = 1\nshape = { " + shape +
         " }\nposition = [0, 0, " + std::to_string(z) + "]\n" + more;
}

std::string link(const std::string& name, double x, double y) {
  return "[[body]]\nname = \"" + name + "\"\nmass = 1\nshape = { sphere = { radius = 0.1 } }\n" +
         "position = [" + std::to_string(x) + ", " + std::to_string(y) + ", 3]\n";
}

std::string constraint(const std::string& type, const std::string& a, const std::string& more) {
  return "[[constraint]]\ntype = \"" + type + "\"\na = \"" + a + "\"\nb = \"world\"\n" + more +
         "\n";
}

}  // namespace

TEST_CASE("corner forces of a resting box are not unique, the force on a ball is") {
  const auto corners = uniqueness(body("box = { size = [0.2, 0.2, 0.2] }", 0.1));
  CHECK(corners.size() == 4);
  for (const auto& [name, is_unique] : corners) CHECK_FALSE(is_unique);
  const auto ball = uniqueness(body("sphere = { radius = 0.1 }", 0.1));
  CHECK(ball == std::map<std::string, bool>{{"contact/floor-b", true}});
}

TEST_CASE("at the two ends of a rod friction along it is not unique, unless it slides") {
  const std::string rod = "capsule = { radius = 0.1, length = 1 }";
  const std::string lying = "orientation = [0.7071067811865476, 0, 0.7071067811865476, 0]\n";
  for (const auto& [name, is_unique] : uniqueness(body(rod, 0.1, lying))) CHECK_FALSE(is_unique);
  const auto sliding = uniqueness(body(rod, 0.1, lying + "linear_velocity = [0, 2, 0]\n"));
  CHECK(sliding.size() == 2);
  for (const auto& [name, is_unique] : sliding) CHECK(is_unique);
}

TEST_CASE("springs in contact determine their forces") {
  const auto corners =
      uniqueness("contact = \"compliant\"\n" + body("box = { size = [0.2, 0.2, 0.2] }", 0.09999));
  CHECK(corners.size() == 4);
  for (const auto& [name, is_unique] : corners) CHECK(is_unique);
}

TEST_CASE("a second hinge on the same axis makes both redundant, one ball joint is not") {
  const std::string pivot = "point = [0, 0, 3]\n";
  const auto one = uniqueness(link("a", 1, 0) + constraint("ball", "a", pivot));
  CHECK(one == std::map<std::string, bool>{{"constraint/constraint0", true}});
  const std::string hinge = "axis = [0, 0, 1]\npoint = [0, 0, ";
  const auto two = uniqueness(link("a", 1, 0) + constraint("hinge", "a", hinge + "3]") +
                              constraint("hinge", "a", hinge + "4]"));
  CHECK(two.size() == 2);
  for (const auto& [name, is_unique] : two) CHECK_FALSE(is_unique);
}
