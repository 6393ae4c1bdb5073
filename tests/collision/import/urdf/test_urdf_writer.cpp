// Writing a robot and reading it again is bit-identical.

#include <random>

#include "collision/import/urdf/urdf.h"
#include "solver/support/number_text.h"
#include "tests/collision/import/robot/helpers.h"

namespace twinarm {
namespace {

using Type = JointDescription::Type;

// Random doubles with all mantissa bits, both signs and many magnitudes; fixed seed.
class Numbers {
 public:
  double any() { return std::ldexp(unit_(generator_) - 0.5, exponent_(generator_)); }
  double positive() { return std::abs(any()) + 1e-12; }
  Vector3 vector() { return {any(), any(), any()}; }

 private:
  std::mt19937_64 generator_{20240607};
  std::uniform_real_distribution<double> unit_;
  std::uniform_int_distribution<int> exponent_{-20, 6};
};

LinkDescription random_link(const std::string& name, const fs::path& mesh, Numbers& numbers) {
  LinkDescription link;
  link.name = name;
  link.has_inertia = true;
  link.mass = numbers.positive();
  link.com = numbers.vector();
  // Of random points: a physically possible inertia.
  for (int k = 0; k < 5; ++k) {
    const Vector3 r = numbers.vector();
    link.inertia += r.squaredNorm() * Matrix3::Identity() - r * r.transpose();
  }
  const ShapeDescription shapes[] = {Box{numbers.vector().cwiseAbs() + Vector3::Constant(1e-9)},
                                     Sphere{numbers.positive()},
                                     Cylinder{numbers.positive(), numbers.positive()},
                                     Capsule{numbers.positive(), numbers.positive()},
                                     MeshGeometry{mesh, numbers.vector(), {}},
                                     MeshGeometry{mesh, Vector3::Ones(), {}},
                                     MeshGeometry{{}, numbers.vector(), "package://lost/a.stl"}};
  for (const ShapeDescription& shape : shapes) {
    VisualPart visual;
    visual.name = name + " <&\"'> " + std::to_string(link.visuals.size());
    visual.origin = {numbers.vector(), numbers.vector()};
    visual.geometry = shape;
    // Some names occur again with another colour; some visuals have no name.
    visual.material = link.visuals.size() % 3 ? "paint" + std::to_string(link.visuals.size()) : "";
    visual.color = Vector4(0.1, 1.0 / 3, std::min(1.0, numbers.positive()), 1);
    link.visuals.push_back(visual);
    link.collisions.push_back({"", 0, visual.origin, shape});
  }
  return link;
}

RobotDescription random_robot(const fs::path& mesh) {
  Numbers numbers;
  RobotDescription robot;
  robot.name = "random";
  robot.root = "link0";
  const Type types[] = {Type::revolute,  Type::continuous,  Type::prismatic, Type::floating,
                        Type::fixed,     Type::planar,      Type::screw,     Type::screw,
                        Type::universal, Type::cylindrical, Type::spherical};
  robot.links.push_back(random_link("link0", mesh, numbers));
  for (int k = 1; k <= 33; ++k) {
    robot.links.push_back(random_link("link" + std::to_string(k), mesh, numbers));
    JointDescription joint;
    joint.name = "joint" + std::to_string(k);
    joint.type = types[k % 11];
    joint.parent = "link" + std::to_string(k / 2);
    joint.child = "link" + std::to_string(k);
    joint.origin = {numbers.vector(), numbers.vector()};
    if (joint.has_axis()) joint.axis = numbers.vector().normalized();
    if (joint.type == Type::screw) joint.pitch = numbers.any();
    // Some screws have limits.
    if (joint.is_limited() || (joint.type == Type::screw && k % 2)) {
      joint.lower = numbers.any();
      joint.upper = joint.lower + numbers.positive();
    }
    joint.effort = numbers.positive();
    joint.velocity = numbers.positive();
    joint.damping = numbers.positive();
    joint.friction = numbers.positive();
    joint.armature = numbers.positive();
    joint.coulomb_plus = k % 2 ? joint.friction : numbers.positive();
    joint.coulomb_minus = k % 3 ? joint.friction : numbers.positive();
    // Mimic joints of the joint before them.
    if (joint.type == Type::revolute && k > 11)
      joint.mimic = {"joint" + std::to_string(k - 11), numbers.any(), numbers.any()};
    robot.joints.push_back(joint);
  }
  robot.links[0].has_inertia = false;
  robot.links[0].mass = 0;
  robot.links[0].com.setZero();
  robot.links[0].inertia.setZero();
  return robot;
}

TEST_CASE("a robot that is written and read again is bit-identical") {
  const TemporaryFolder folder;
  const fs::path mesh = folder.write("meshes/part one.stl", "solid\nendsolid\n");
  const RobotDescription robot = random_robot(mesh);
  write_urdf(robot, folder.path() / "robot.urdf", "two -- lines\nof comment --");
  // One mesh does not exist.
  const RobotFileOptions options{RobotFileOptions::Geometry::optional, true};
  const RobotDescription again = read_urdf(folder.path() / "robot.urdf", options);
  check_same(again, robot, 0.0);
  write_urdf(again, folder.path() / "again.urdf", "two -- lines\nof comment --");
  CHECK(text_of(folder.path() / "again.urdf") == text_of(folder.path() / "robot.urdf"));
}

TEST_CASE("negative zeros are preserved") {
  const TemporaryFolder folder;
  RobotDescription robot = read_urdf(folder.write("arm.urdf", kGoodArm));
  robot.links[1].com = Vector3(-0.0, 0.0, -0.0);
  robot.joints[0].origin.xyz = Vector3(0.0, -0.0, 0.0);
  robot.joints[0].lower = -0.0;
  write_urdf(robot, folder.path() / "out.urdf");
  check_same(read_urdf(folder.path() / "out.urdf"), robot, 0.0);
}

TEST_CASE("a URDF that is read and written keeps a rotated inertia") {
  const TemporaryFolder folder;
  const std::string text =
      replaced(kGoodArm, "xyz=\"0.2 0 0\"", "xyz=\"0.2 0 0\" rpy=\"0.1 0.2 0.3\"");
  const RobotDescription robot = read_urdf(folder.write("arm.urdf", text));
  write_urdf(robot, folder.path() / "out.urdf");
  check_same(read_urdf(folder.path() / "out.urdf"), robot, 0.0);
}

TEST_CASE("writing leaves no temporary file, and reports where it cannot write") {
  const TemporaryFolder folder;
  const RobotDescription robot = read_urdf(folder.write("arm.urdf", kGoodArm));
  write_urdf(robot, folder.path() / "out.urdf");
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 2);
  const fs::path nowhere = folder.path() / "arm.urdf" / "out.urdf";  // below a file
  const auto faults = faults_of([&] { write_urdf(robot, nowhere); });
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].file == nowhere.string());
  fs::create_directories(folder.path() / "taken.urdf");  // a folder: renaming fails
  CHECK(faults_of([&] { write_urdf(robot, folder.path() / "taken.urdf"); }).size() == 1);
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 3);
}

TEST_CASE("numbers are written with the fewest exact digits, and only numbers are read") {
  CHECK(number_text(0.1) == "0.1");
  CHECK(number_text(1.0 / 3) == "0.3333333333333333");
  CHECK(number_text(25) == "25");
  CHECK(parse_number("+1.5") == 1.5);
  CHECK(parse_number("-1e-3") == -1e-3);
  for (const char* text : {"", "+", "+-1", "1,5", "1.5 ", "nan", "-inf", "1e400", "0x1p3", "1.5m"})
    CHECK_MESSAGE(!parse_number(text).has_value(), text);
}

}  // namespace
}  // namespace twinarm
