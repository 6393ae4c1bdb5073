// Every fault of a scene is told, with its line, and all of them at once.
#include "tests/scene/helpers.h"

namespace twinarm {
namespace {

const char* const kArm =
    "[[robot]]\nname = 'arm'\nmodel = 'robots/findings_set0/findings_set0.urdf'\n";

// A good body whose fifth line is to be tested.
std::string body_with(const std::string& line) {
  return "[[body]]\nname = 'b'\nmass = 1\nshape.sphere.radius = 0.1\n" + line + "\n";
}
std::string shape_of(const std::string& shape) {
  return "[[body]]\nname = 'b'\nfixed = true\nshape = { " + shape + " }\n";
}

TEST_CASE("scene: what is left out has its default") {
  const SceneDescription scene = scene_of(body_with(""));
  CHECK(scene.gravity == Vector3(0, 0, -9.81));
  CHECK(scene.step == 0.001);
  CHECK(scene.contact == ContactMode::rigid);
  CHECK(!scene.integrator);
  CHECK(!scene.duration);
  REQUIRE(scene.bodies.size() == 1);
  CHECK(scene.bodies[0].surface.friction == 0.5);
  CHECK(scene.bodies[0].surface.restitution == 0);
  CHECK(scene.bodies[0].is_free());
  CHECK(scene.warnings.empty());
}

TEST_CASE("scene: each faulty key is told with its line, its rule and a remedy") {
  struct Case {
    const char *line, *part;
  };
  for (const Case& c : {
           Case{"frictoin = 0.5", "did you mean 'friction'"},
           Case{"friction = -0.1", "must not be negative, is -0.1"},
           Case{"friction = 'much'", "must be a number, is the text 'much'"},
           Case{"friction = nan", "must be finite"},
           Case{"restitution = 1.01", "at most 1"},
           Case{"restitution = -1", "must not be negative"},
           Case{"rolling_friction = -1", "must not be negative"},
           Case{"stiffness = 0", "must be positive, is 0; give a number above 0"},
           Case{"stiffness = -1e5", "must be positive, is -1e"},
           Case{"stiffness = inf", "must be finite"},
           Case{"stiffness = '1e5'", "must be a number, is the text"},
           Case{"dissipation = -1", "must not be negative, is -1; give 0 or more"},
           Case{"dissipation = nan", "must be finite"},
           Case{"stifness = 1e5", "did you mean 'stiffness'"},
           Case{"torsional_friction = true", "must be a number, is true"},
           Case{"orientation = [0, 0, 0, 0]", "has length 1, this one has 0"},
           Case{"orientation = [1, 1, 0, 0]", "this one has 1.41421"},
           Case{"orientation = [1, 0, 0]", "a list of 4 finite numbers, is a list of 3"},
           Case{"position = [0, 0, inf]", "a list of 3 finite numbers"},
           Case{"position = [0, 0, '1']", "with the text '1'"},
           Case{"group = 32", "whole number from 0 to 31"},
           Case{"group = 1.5", "whole number from 0 to 31"},
           Case{"fixed = 'yes'", "must be true or false"},
           Case{"density = 1000", "the body has a mass already"},
           Case{"com = [0, 0, 0.1]", "goes with 'inertia'"},
           Case{"inertia = [1, 1, 0, 0, 0, 0]", "must be positive"},
           Case{"inertia = [1, 1, 1]", "a list of 6"},
           Case{"motion = { linaer = [1, 0, 0] }", "did you mean 'linear'"},
       })
    check_fault(body_with(c.line), 5, c.part);
  check_fault("[[body]]\nname = 'b'\nmass = 0\nshape.sphere.radius = 0.1\n", 3, "must be positive");
  check_fault("[[body]]\nname = 'b'\nshape.sphere.radius = 0.1\n", 1, "a free body needs a mass");
  check_fault("[[body]]\nmass = 1\nshape.sphere.radius = 0.1\n", 1, "name: is missing");
  check_fault("[[body]]\nname = 'b'\nmass = 1\n", 1, "shape: is missing");
  check_fault("[[body]]\nname = 'a/b'\nmass = 1\nshape.sphere.radius = 1\n", 2, "contain '/'");
  check_fault("[[body]]\nname = 'world'\nmass = 1\nshape.sphere.radius = 1\n", 2, "world itself");
  check_fault(body_with("") + body_with(""), 7, "taken already");
  check_fault(body_with("fixed = true\nlinear_velocity = [1, 0, 0]"), 6, "of a free body");
}

TEST_CASE("scene: shapes without size, of unknown name, two at once, are told") {
  check_fault(shape_of("box = { size = [1, 0, 1] }"), 4, "all three must be positive");
  check_fault(shape_of("sphere = { radius = 0 }"), 4, "must be positive, is 0");
  check_fault(shape_of("cylinder = { radius = 1 }"), 4, "length: is missing");
  check_fault(shape_of("capsule = { radius = 1, length = 0 }"), 4, "must be positive");
  check_fault(shape_of("ellipsoid = { semi_axes = [1, 2] }"), 4, "a list of 3");
  check_fault(shape_of("halfspace = { normal = [0, 0, 2], offset = 0 }"), 4, "must have length 1");
  check_fault(shape_of("halfspace = { normal = [0, 0, 0] }"), 4, "must have length 1, has 0");
  check_fault(shape_of("bax = { size = [1, 1, 1] }"), 4, "did you mean 'box'");
  check_fault(shape_of("box = 1"), 4, "must be a table");
  check_fault(shape_of("mesh = { file = 'none.stl' }"), 4, "'none.stl' does not exist");
  check_fault(shape_of("box = { size = [1, 1, 1] }, sphere = { radius = 1 }"), 4,
              "names box and sphere");
  check_fault(shape_of(""), 4, "names no shape");
}

TEST_CASE("scene: what has no inside must be fixed or moved") {
  for (const char* shape : {"halfspace = { normal = [0, 0, 1] }", "hollow_sphere = { radius = 1 }",
                            "hollow_cylinder = { radius = 1, length = 1 }"}) {
    const std::string begin = "[[body]]\nname = 'b'\nshape = { " + std::string(shape) + " }\n";
    check_fault(begin + "mass = 1\n", 3, "it cannot be a free body");
    CHECK(scene_faults(begin + "fixed = true\n").empty());
    CHECK(scene_faults(begin + "motion = { linear = [1, 0, 0] }\n").empty());
  }
}

TEST_CASE(
    "scene: faults of the top, of robots, pairs, couplings and constraints have their lines") {
  check_fault("gravty = [0, 0, 0]\n", 1, "did you mean 'gravity'");
  check_fault("step = 0\n", 1, "must be positive");
  check_fault("duration = -1\n", 1, "must be positive");
  check_fault("contact = 'soft'\n", 1, "possible: rigid compliant event");
  check_fault("integrator = 'rk5'\n", 1, "did you mean 'rk4'");
  check_fault("body = 1\n", 1, "two brackets");
  check_fault("[[body]\n", 1, "not well-formed TOML");
  check_fault("[[robot]]\nname = 'arm'\n", 1, "model: is missing");
  check_fault("[[robot]]\nname = 'arm'\nmodel = 'robots/no.urdf'\n", 3, "does not exist");
  check_fault(std::string(kArm) + "base = 'free'\n", 4, "possible: fixed floating");
  check_fault(std::string(kArm) + "q = { joint3 = 1 }\n", 4, "did you mean 'joint1'");
  check_fault(std::string(kArm) + "q = { joint1 = [1, 2] }\n", 4, "must be a number");
  check_fault(std::string(kArm) + "linear_velocity = [1, 0, 0]\n", 4, "stands on the world");
  check_fault(std::string(kArm) + "[[body]]\nname = 'arm1'\nmass = 1\nshape.sphere.radius = 1\n", 5,
              "a link of robot 'arm'");

  const std::string ball = body_with("");
  check_fault(ball + "[[pair]]\na = 'b'\nb = 'flor'\n", 8, "there is no body or robot 'flor'");
  check_fault(ball + "[[pair]]\na = 'b'\nb = 'world'\n", 8, "the world has no surface");
  check_fault(ball + "[[pair]]\na = 'b'\nb = 'b'\nrestitution = 2\n", 9, "at most 1");

  const std::string pair = ball + "[[pair]]\na = 'b'\nb = 'b'\n";
  check_fault(pair + "stiffness = 0\n", 9, "must be positive, is 0");
  check_fault(pair + "dissipation = -1\n", 9, "must not be negative, is -1");
  check_fault(std::string(kArm) + "stiffness = -1\n", 4, "must be positive, is -1");

  const std::string pull = std::string(kArm) + "[[coupling]]\nstiffness = 1\n";
  const std::string linear = pull + "type = 'linear'\n";
  check_fault(pull + "link = 'arm1'\n", 4, "type: is missing");
  check_fault(linear, 4, "link: is missing");
  check_fault(linear + "link = 'arm3'\n", 7, "there is no link 'arm3'");
  check_fault(linear + "link = 'arm1'\nrobot = 'amr'\n", 8, "did you mean 'arm'");
  check_fault(linear + "link = 'arm1'\nmeasure = 'joint'\n", 8, "of a torsional coupling");
  check_fault(linear + "link = 'arm1'\nrate = 100\ntreatment = 'implicit'\n", 8, "is explicit");
  check_fault(linear + "link = 'arm1'\ntarget = 'pepar'\n", 8, "'pepar' does not exist");
  const std::string late = linear + "link = 'arm1'\ntarget = 'paper'\n";
  CHECK(scene_faults(late + "delay = 0.0314\nspeed = 0.5\n").empty());
  check_fault(late + "delay = -1\n", 9, "must not be negative");
  check_fault(late + "delay = 'long'\n", 9, "must be a number");
  check_fault(late + "speed = 0\n", 9, "must be positive");
  check_fault(late + "speed = inf\n", 9, "must be finite");
  check_fault(linear + "link = 'arm1'\ndelay = 0.1\n", 8, "the target stands still");
  check_fault(linear + "link = 'arm1'\nspeed = 2\n", 8, "a motion by name or a trace");
  check_fault(linear + "link = 'arm1'\ntarget = { q = { joint1 = 1 } }\nspeed = 2\n", 9,
              "a motion by name or a trace");
  check_fault(linear + "link = 'arm1'\noutside = [0, 1]\n", 8, "a stop is a torsional coupling");
  check_fault(pull + "type = 'torsional'\nmeasure = 'joint'\nlink = 'arm1'\noutside = [1, 0]\n", 9,
              "the first is above the second");
  check_fault(linear + "link = 'arm1'\ngripper = { joint = 'joint1', open = 0, closed = 1 }\n", 8,
              "no hand moves this target");
  check_fault(linear + "link = 'arm1'\ntarget = 'paper'\n" +
                  "gripper = { joint = 'joint7', open = 0, closed = 1 }\n",
              9, "did you mean 'joint1'");
  check_fault(linear + "link = 'arm1'\ntarget = { seed = 0.5 }\n", 8, "must be a whole number");
  check_fault(std::string(kArm) + "mass_scale = { arm3 = 2 }\n", 4, "there is no link 'arm3'");
  check_fault(std::string(kArm) + "mass_scale = { arm1 = 0 }\n", 4, "must be positive, is 0");
  check_fault(std::string(kArm) + "payload = [{ link = 'arm1', mass = -1 }]\n", 4,
              "must not be negative");
  check_fault(std::string(kArm) + "payload = [{ link = 'arm9', mass = 1 }]\n", 4,
              "there is no link 'arm9'");
  check_fault(linear + "link = 'arm1'\ntarget = { q = { joint9 = 1 } }\n", 8, "no such joint");
  check_fault(pull + "type = 'torsional'\nlink = 'base'\nmeasure = 'joint'\n", 7,
              "not one degree of freedom");

  const std::string tie = ball + "[[constraint]]\na = 'b'\n";
  check_fault(tie + "type = 'weld'\nb = 'c'\n", 9, "there is no body 'c'");
  check_fault(tie + "type = 'weld'\nb = 'b'\n", 9, "the same as a");
  check_fault(tie + "type = 'ball'\nb = 'world'\n", 6, "point: is missing");
  check_fault(tie + "type = 'hinge'\nb = 'world'\npoint = [0, 0, 0]\n", 6, "axis: is missing");
  check_fault(tie + "type = 'hinge'\nb = 'world'\npoint = [0, 0, 0]\naxis = [0, 0, 0]\n", 11,
              "has no direction");
  check_fault(tie + "type = 'ball'\nb = 'world'\npoint = [0, 0, 0]\nratio = 2\n", 11, "of a gear");
  check_fault(std::string(kArm) +
                  "[[constraint]]\ntype = 'gear'\na = 'arm/joint1'\nb = 'arm/joint5'\nratio = 2\n",
              7, "there is no joint 'arm/joint5'");
}

TEST_CASE("scene: all faults are told at once, in the order of their lines") {
  const std::vector<Fault> faults = scene_faults(
      "step = -1\n"
      "[[pair]]\na = 'x'\nb = 'y'\n"
      "[[body]]\nname = 'b'\nmass = -1\nfriction = -1\nshape.sphere.radius = -1\n"
      "[[robot]]\nname = 'arm'\nmodel = 'no.urdf'\ncolour = 'red'\n");
  std::vector<int> lines;
  for (const Fault& fault : faults) lines.push_back(fault.line);
  CHECK(lines == std::vector<int>{1, 3, 4, 7, 8, 9, 12, 13});
}

TEST_CASE("scene: faults of a robot's own file stand beside those of the scene") {
  const TemporaryFolder folder;
  folder.write("bad.urdf", "<robot name='r'>\n<link name='a'/><link name='a'/>\n</robot>\n");
  const auto scene =
      folder.write("test.toml", "step = 0\n[[robot]]\nname = 'r'\nmodel = 'bad.urdf'\n");
  const std::vector<Fault> faults = faults_of([&] { read_scene(scene); });
  REQUIRE(faults.size() == 2);
  CHECK(faults[0].file == scene.string());
  CHECK(faults[1].file.find("bad.urdf") != std::string::npos);
  CHECK(faults[1].line == 2);
}

TEST_CASE("scene: a file that is not there is told") {
  const std::vector<Fault> faults = faults_of([] { read_scene("no/such/scene.toml"); });
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].rule == "the file does not exist");
}

}  // namespace
}  // namespace twinarm
