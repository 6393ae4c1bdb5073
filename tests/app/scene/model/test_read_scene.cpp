// Every fault of a scene is told, with its line, and all of them at once.
#include "tests/app/scene/model/helpers.h"

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

TEST_CASE("scene: each faulty key is told with its line, its code and the value that was found") {
  struct Case {
    const char *line, *code, *value;
  };
  for (const Case& c : {
           Case{"frictoin = 0.5", "scene.unknown-key", "'friction'"},
           Case{"friction = -0.1", "scene.negative", "-0.1"},
           Case{"friction = 'much'", "scene.type", "'much'"},
           Case{"friction = nan", "scene.not-finite", "friction"},
           Case{"restitution = 1.01", "scene.range", "restitution"},
           Case{"restitution = -1", "scene.negative", "-1"},
           Case{"rolling_friction = -1", "scene.negative", "-1"},
           Case{"stiffness = 0", "scene.not-positive", "stiffness"},
           Case{"stiffness = -1e5", "scene.not-positive", "-1e"},
           Case{"stiffness = inf", "scene.not-finite", "stiffness"},
           Case{"stiffness = '1e5'", "scene.type", "'1e5'"},
           Case{"dissipation = -1", "scene.negative", "-1"},
           Case{"dissipation = nan", "scene.not-finite", "dissipation"},
           Case{"stifness = 1e5", "scene.unknown-key", "'stiffness'"},
           Case{"torsional_friction = true", "scene.type", "true"},
           Case{"orientation = [0, 0, 0, 0]", "scene.length", "0"},
           Case{"orientation = [1, 1, 0, 0]", "scene.length", "1.41421"},
           Case{"orientation = [1, 0, 0]", "scene.list", "4"},
           Case{"position = [0, 0, inf]", "scene.list", "3"},
           Case{"position = [0, 0, '1']", "scene.list", "'1'"},
           Case{"group = 32", "scene.range", "group"},
           Case{"group = 1.5", "scene.range", "group"},
           Case{"fixed = 'yes'", "scene.type", "fixed"},
           Case{"density = 1000", "scene.two-keys", "density"},
           Case{"com = [0, 0, 0.1]", "scene.key-alone", "'inertia'"},
           Case{"inertia = [1, 1, 0, 0, 0, 0]", "scene.inertia", "inertia"},
           Case{"inertia = [1, 1, 1]", "scene.list", "6"},
           Case{"motion = { linaer = [1, 0, 0] }", "scene.unknown-key", "'linear'"},
       })
    check_fault(body_with(c.line), 5, c.code, c.value);
  check_fault("[[body]]\nname = 'b'\nmass = 0\nshape.sphere.radius = 0.1\n", 3,
              "scene.not-positive", "mass");
  check_fault("[[body]]\nname = 'b'\nshape.sphere.radius = 0.1\n", 1, "scene.missing", "'b'");
  check_fault("[[body]]\nmass = 1\nshape.sphere.radius = 0.1\n", 1, "scene.missing", "name");
  check_fault("[[body]]\nname = 'b'\nmass = 1\n", 1, "scene.missing", "shape");
  check_fault("[[body]]\nname = 'a/b'\nmass = 1\nshape.sphere.radius = 1\n", 2, "scene.name",
              "'/'");
  check_fault("[[body]]\nname = 'world'\nmass = 1\nshape.sphere.radius = 1\n", 2, "scene.name",
              "'world'");
  check_fault(body_with("") + body_with(""), 7, "scene.name-taken", "'b'");
  check_fault(body_with("fixed = true\nlinear_velocity = [1, 0, 0]"), 6, "scene.key-useless",
              "linear_velocity");
}

TEST_CASE("scene: shapes without size, of unknown name, two at once, are told") {
  check_fault(shape_of("box = { size = [1, 0, 1] }"), 4, "scene.not-positive", "size");
  check_fault(shape_of("sphere = { radius = 0 }"), 4, "scene.not-positive", "0");
  check_fault(shape_of("cylinder = { radius = 1 }"), 4, "scene.missing", "length");
  check_fault(shape_of("capsule = { radius = 1, length = 0 }"), 4, "scene.not-positive", "length");
  check_fault(shape_of("ellipsoid = { semi_axes = [1, 2] }"), 4, "scene.list", "3");
  check_fault(shape_of("halfspace = { normal = [0, 0, 2], offset = 0 }"), 4, "scene.length", "2");
  check_fault(shape_of("halfspace = { normal = [0, 0, 0] }"), 4, "scene.length", "0");
  check_fault(shape_of("bax = { size = [1, 1, 1] }"), 4, "scene.unknown-key", "'box'");
  check_fault(shape_of("box = 1"), 4, "scene.type", "box");
  check_fault(shape_of("mesh = { file = 'none.stl' }"), 4, "file.missing", "'none.stl'");
  check_fault(shape_of("box = { size = [1, 1, 1] }, sphere = { radius = 1 }"), 4, "scene.shapes",
              "sphere");
  check_fault(shape_of(""), 4, "scene.shapes", "shape");
}

TEST_CASE("scene: what has no inside must be fixed or moved") {
  for (const char* shape : {"halfspace = { normal = [0, 0, 1] }", "hollow_sphere = { radius = 1 }",
                            "hollow_cylinder = { radius = 1, length = 1 }"}) {
    const std::string begin = "[[body]]\nname = 'b'\nshape = { " + std::string(shape) + " }\n";
    check_fault(begin + "mass = 1\n", 3, "scene.no-inside", "'b'");
    CHECK(scene_faults(begin + "fixed = true\n").empty());
    CHECK(scene_faults(begin + "motion = { linear = [1, 0, 0] }\n").empty());
  }
}

TEST_CASE(
    "scene: faults of the top, of robots, pairs, couplings and constraints have their lines") {
  check_fault("gravty = [0, 0, 0]\n", 1, "scene.unknown-key", "'gravity'");
  check_fault("step = 0\n", 1, "scene.not-positive", "step");
  check_fault("duration = -1\n", 1, "scene.not-positive", "duration");
  check_fault("contact = 'soft'\n", 1, "scene.choice", "rigid compliant event");
  check_fault("integrator = 'rk5'\n", 1, "scene.choice", "'rk4'");
  check_fault("body = 1\n", 1, "scene.type", "[[body]]");
  check_fault("[[body]\n", 1, "file.toml");
  check_fault("[[robot]]\nname = 'arm'\n", 1, "scene.missing", "model");
  check_fault("[[robot]]\nname = 'arm'\nmodel = 'robots/no.urdf'\n", 3, "file.missing",
              "'robots/no.urdf'");
  check_fault(std::string(kArm) + "base = 'free'\n", 4, "scene.choice", "fixed floating");
  check_fault(std::string(kArm) + "q = { joint3 = 1 }\n", 4, "scene.unknown-name", "'joint1'");
  check_fault(std::string(kArm) + "q = { joint1 = [1, 2] }\n", 4, "scene.type", "joint1");
  check_fault(std::string(kArm) + "linear_velocity = [1, 0, 0]\n", 4, "scene.key-useless",
              "linear_velocity");
  check_fault(std::string(kArm) + "[[body]]\nname = 'arm1'\nmass = 1\nshape.sphere.radius = 1\n", 5,
              "scene.name-taken", "'arm'");

  const std::string ball = body_with("");
  check_fault(ball + "[[pair]]\na = 'b'\nb = 'flor'\n", 8, "scene.unknown-name", "'flor'");
  check_fault(ball + "[[pair]]\na = 'b'\nb = 'world'\n", 8, "scene.unknown-name", "b");
  check_fault(ball + "[[pair]]\na = 'b'\nb = 'b'\nrestitution = 2\n", 9, "scene.range",
              "restitution");

  const std::string pair = ball + "[[pair]]\na = 'b'\nb = 'b'\n";
  check_fault(pair + "stiffness = 0\n", 9, "scene.not-positive", "0");
  check_fault(pair + "dissipation = -1\n", 9, "scene.negative", "-1");
  check_fault(std::string(kArm) + "stiffness = -1\n", 4, "scene.not-positive", "-1");

  const std::string pull = std::string(kArm) + "[[coupling]]\nstiffness = 1\n";
  const std::string linear = pull + "type = 'linear'\n";
  check_fault(pull + "link = 'arm1'\n", 4, "scene.missing", "type");
  check_fault(linear, 4, "scene.missing", "link");
  check_fault(linear + "link = 'arm3'\n", 7, "scene.unknown-name", "'arm3'");
  check_fault(linear + "link = 'arm1'\nrobot = 'amr'\n", 8, "scene.unknown-name", "'arm'");
  check_fault(linear + "link = 'arm1'\nmeasure = 'joint'\n", 8, "scene.key-useless", "measure");
  check_fault(linear + "link = 'arm1'\nrate = 100\ntreatment = 'implicit'\n", 8, "scene.treatment",
              "rate");
  check_fault(linear + "link = 'arm1'\ntarget = 'pepar'\n", 8, "file.missing", "'pepar'");
  const std::string late = linear + "link = 'arm1'\ntarget = 'paper'\n";
  CHECK(scene_faults(late + "delay = 0.0314\nspeed = 0.5\n").empty());
  check_fault(late + "delay = -1\n", 9, "scene.negative", "-1");
  check_fault(late + "delay = 'long'\n", 9, "scene.type", "'long'");
  check_fault(late + "speed = 0\n", 9, "scene.not-positive", "speed");
  check_fault(late + "speed = inf\n", 9, "scene.not-finite", "speed");
  check_fault(linear + "link = 'arm1'\ndelay = 0.1\n", 8, "scene.key-useless", "delay");
  check_fault(linear + "link = 'arm1'\nspeed = 2\n", 8, "scene.key-useless", "speed");
  check_fault(linear + "link = 'arm1'\ntarget = { q = { joint1 = 1 } }\nspeed = 2\n", 9,
              "scene.key-useless", "speed");
  check_fault(linear + "link = 'arm1'\noutside = [0, 1]\n", 8, "scene.stop", "outside");
  check_fault(pull + "type = 'torsional'\nmeasure = 'joint'\nlink = 'arm1'\noutside = [1, 0]\n", 9,
              "scene.order", "outside");
  check_fault(linear + "link = 'arm1'\ngripper = { joint = 'joint1', open = 0, closed = 1 }\n", 8,
              "scene.key-useless", "gripper");
  check_fault(linear + "link = 'arm1'\ntarget = 'paper'\n" +
                  "gripper = { joint = 'joint7', open = 0, closed = 1 }\n",
              9, "scene.unknown-name", "'joint1'");
  check_fault(linear + "link = 'arm1'\ntarget = { seed = 0.5 }\n", 8, "scene.range", "seed");
  check_fault(std::string(kArm) + "mass_scale = { arm3 = 2 }\n", 4, "scene.unknown-name", "'arm3'");
  check_fault(std::string(kArm) + "mass_scale = { arm1 = 0 }\n", 4, "scene.not-positive", "0");
  check_fault(std::string(kArm) + "payload = [{ link = 'arm1', mass = -1 }]\n", 4, "scene.negative",
              "-1");
  check_fault(std::string(kArm) + "payload = [{ link = 'arm9', mass = 1 }]\n", 4,
              "scene.unknown-name", "'arm9'");
  check_fault(linear + "link = 'arm1'\ntarget = { q = { joint9 = 1 } }\n", 8, "scene.unknown-name",
              "joint9");
  check_fault(pull + "type = 'torsional'\nlink = 'base'\nmeasure = 'joint'\n", 7,
              "scene.degrees-of-freedom", "link");

  const std::string tie = ball + "[[constraint]]\na = 'b'\n";
  check_fault(tie + "type = 'weld'\nb = 'c'\n", 9, "scene.unknown-name", "'c'");
  check_fault(tie + "type = 'weld'\nb = 'b'\n", 9, "scene.same-ends", "b");
  check_fault(tie + "type = 'ball'\nb = 'world'\n", 6, "scene.missing", "point");
  check_fault(tie + "type = 'hinge'\nb = 'world'\npoint = [0, 0, 0]\n", 6, "scene.missing", "axis");
  check_fault(tie + "type = 'hinge'\nb = 'world'\npoint = [0, 0, 0]\naxis = [0, 0, 0]\n", 11,
              "scene.no-direction", "axis");
  check_fault(tie + "type = 'ball'\nb = 'world'\npoint = [0, 0, 0]\nratio = 2\n", 11,
              "scene.key-useless", "ratio");
  check_fault(std::string(kArm) +
                  "[[constraint]]\ntype = 'gear'\na = 'arm/joint1'\nb = 'arm/joint5'\nratio = 2\n",
              7, "scene.unknown-name", "'arm/joint5'");
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
  CHECK(faults[0].code == "file.missing");
}

}  // namespace
}  // namespace twinarm
