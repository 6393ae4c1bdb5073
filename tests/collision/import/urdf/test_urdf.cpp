// Valid URDF files: the description has their contents.
#include "collision/import/urdf/urdf.h"

#include <Eigen/Geometry>
#include <array>
#include <cstdlib>
#include <optional>

#include "collision/import/robot/robot_check.h"
#include "collision/import/robot/robot_model.h"
#include "tests/collision/import/robot/helpers.h"

namespace twinarm {
namespace {

using Type = JointDescription::Type;

TEST_CASE("the numbers of a URDF are read exactly") {
  const TemporaryFolder folder;
  const RobotDescription robot = read_urdf(folder.write("arm.urdf", kGoodArm));
  CHECK(robot.name == "arm");
  CHECK(robot.root == "base");
  REQUIRE(robot.links.size() == 2);
  CHECK(!robot.links[0].has_inertia);
  const LinkDescription& arm = robot.links[1];
  CHECK(arm.line == 3);
  CHECK(arm.mass == 2);
  CHECK(arm.com == Vector3(0.2, 0, 0));
  CHECK(arm.inertia == Matrix3(Vector3(0.01, 0.02, 0.025).asDiagonal()));
  REQUIRE(arm.visuals.size() == 1);
  CHECK(std::get<Box>(arm.visuals[0].geometry).size == Vector3(0.4, 0.1, 0.1));
  REQUIRE(robot.joints.size() == 1);
  const JointDescription& joint = robot.joints[0];
  CHECK(joint.type == Type::revolute);
  CHECK(joint.line == 13);
  CHECK(joint.axis == Vector3::UnitZ());
  CHECK(joint.lower == -1);
  CHECK(joint.upper == 1.5);
  CHECK(joint.damping == 0.1);
  CHECK(joint.coulomb_plus == 0.2);
  CHECK(joint.coulomb_minus == 0.2);
  CHECK(joint.armature == 0);
}

TEST_CASE("roll, pitch and yaw rotate about the fixed axes x, y, z in this order") {
  const double roll = 0.3, pitch = -0.7, yaw = 1.9;
  const Matrix3 expected =
      (Eigen::AngleAxisd(yaw, Vector3::UnitZ()) * Eigen::AngleAxisd(pitch, Vector3::UnitY()) *
       Eigen::AngleAxisd(roll, Vector3::UnitX()))
          .toRotationMatrix();
  const Pose X = Origin{Vector3(1, 2, 3), Vector3(roll, pitch, yaw)}.pose();
  CHECK((X.R - expected).norm() < 1e-15);
  CHECK(X.p == Vector3(1, 2, 3));
}

TEST_CASE("an inertia in rotated axes is transformed to link axes") {
  // A quarter turn about z exchanges ixx and iyy.
  const TemporaryFolder folder;
  const std::string text =
      replaced(kGoodArm, "xyz=\"0.2 0 0\"", "xyz=\"0.2 0 0\" rpy=\"0 0 1.5707963267948966\"");
  const RobotDescription robot = read_urdf(folder.write("arm.urdf", text));
  const Matrix3 expected = Vector3(0.02, 0.01, 0.025).asDiagonal();
  CHECK((robot.links[1].inertia - expected).norm() < 1e-16);
  CHECK(robot.links[1].inertia == Matrix3(robot.links[1].inertia.transpose()));
  CHECK(robot.links[1].com == Vector3(0.2, 0, 0));
}

TEST_CASE("the axis is normalised; its default is x") {
  const TemporaryFolder folder;
  const auto axis = [&](const std::string& element) {
    const std::string text = replaced(kGoodArm, "<axis xyz=\"0 0 1\"/>", element);
    return read_urdf(folder.write("arm.urdf", text)).joints[0].axis;
  };
  CHECK(axis("<axis xyz=\"3 0 4\"/>") == Vector3(3.0 / 5, 0, 4.0 / 5));
  CHECK(axis("") == Vector3::UnitX());
}

TEST_CASE("a missing lower or upper limit is 0") {
  const TemporaryFolder folder;
  const RobotDescription robot =
      read_urdf(folder.write("arm.urdf", replaced(kGoodArm, "lower=\"-1\"", "")));
  CHECK(robot.joints[0].lower == 0);
  CHECK(robot.joints[0].upper == 1.5);
}

TEST_CASE("the twinarm element gives armature and Coulomb friction of each direction") {
  const TemporaryFolder folder;
  const std::string text =
      replaced(kGoodArm, "<axis", "<twinarm armature=\"0.03\" coulomb_plus=\"0.4\"/><axis");
  const JointDescription joint = read_urdf(folder.write("arm.urdf", text)).joints[0];
  CHECK(joint.armature == 0.03);
  CHECK(joint.coulomb_plus == 0.4);
  CHECK(joint.coulomb_minus == 0.2);  // that of <dynamics>
}

TEST_CASE("every joint type has a name, and the name gives the type") {
  for (const Type type :
       {Type::fixed, Type::revolute, Type::continuous, Type::prismatic, Type::floating,
        Type::planar, Type::screw, Type::cylindrical, Type::universal, Type::spherical}) {
    Type found{};
    CHECK(joint_type_from(to_string(type), found));
    CHECK(found == type);
    CHECK(supported_joints().find(to_string(type)) != std::string::npos);
  }
}

TEST_CASE("mesh files are found beside the URDF, in its package, and by file://") {
  const TemporaryFolder folder;
  const fs::path mesh = folder.write("my_robot/meshes/a.stl", "solid\nendsolid\n");
  const fs::path folder_of_urdf = folder.path() / "my_robot" / "urdf";
  fs::create_directories(folder_of_urdf);
  const auto found = [&](const std::string& name) {
    const std::string element = "<mesh filename=\"" + name + "\" scale=\"0.001 0.001 0.001\"/>";
    const std::string text = replaced(kGoodArm, "<box size=\"0.4 0.1 0.1\"/>", element);
    const RobotDescription robot = read_urdf(folder.write("my_robot/urdf/arm.urdf", text));
    const auto& part = std::get<MeshGeometry>(robot.links[1].visuals[0].geometry);
    CHECK(part.scale == Vector3::Constant(0.001));
    CHECK(part.name == name);
    return part.file;
  };
  CHECK(found("../meshes/a.stl") == mesh);
  CHECK(found("package://my_robot/meshes/a.stl") == mesh);
  CHECK(found("file://" + mesh.string()) == mesh);
  CHECK(found(mesh.string()) == mesh);
}

// A tetrahedron with vertices at the origin and on the axes.
const char* const kTetrahedron = R"(v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
f 1 3 2
f 1 2 4
f 1 4 3
f 2 3 4
)";

TEST_CASE("a mesh may be scaled and mirrored, and keeps the outward orientation") {
  // Six times the volume of a tetrahedron at the origin: the product of the scales.
  const TemporaryFolder folder;
  folder.write("a.obj", kTetrahedron);
  for (const Vector3& scale : {Vector3(1, 1, 2), Vector3(-1, 2, 3), Vector3(-0.5, -2, -3)}) {
    std::ostringstream text;
    text << "<mesh filename=\"a.obj\" scale=\"" << scale.transpose() << "\"/>";
    const RobotDescription robot = read_urdf(
        folder.write("arm.urdf", replaced(kGoodArm, "<box size=\"0.4 0.1 0.1\"/>", text.str())));
    const auto& geometry = std::get<MeshGeometry>(robot.links[1].visuals[0].geometry);
    CHECK(geometry.scale == scale);
    const TriangleMesh mesh = load_mesh(geometry);
    double six_volumes = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
      const auto at = [&](int k) { return mesh.vertices[static_cast<std::size_t>(k)]; };
      six_volumes += at(a).dot(at(b).cross(at(c)));
    }
    CHECK(six_volumes == doctest::Approx(std::abs(scale.prod())).epsilon(1e-14));
  }
  const std::string flat = "<mesh filename=\"a.obj\" scale=\"1 0 1\"/>";
  const auto faults = faults_of([&] {
    read_urdf(folder.write("arm.urdf", replaced(kGoodArm, "<box size=\"0.4 0.1 0.1\"/>", flat)));
  });
  CHECK(faults.size() == 1);
  CHECK(tells(faults, 10, "urdf.mesh-scale", "'1 0 1'"));
}

// Sets an environment variable during its lifetime.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) {
    if (const char* old = std::getenv(name)) before_ = old;
    ::setenv(name, value.c_str(), 1);
  }
  ~Environment() {
    if (before_)
      ::setenv(name_, before_->c_str(), 1);
    else
      ::unsetenv(name_);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

TEST_CASE("a package is searched in ROS_PACKAGE_PATH and AMENT_PREFIX_PATH") {
  const TemporaryFolder urdfs, packages;
  const fs::path direct = packages.write("src/near/a.stl", "solid\nendsolid\n");
  const fs::path nested = packages.write("src/repository/far/a.stl", "solid\nendsolid\n");
  const fs::path itself = packages.write("single/a.stl", "solid\nendsolid\n");
  const fs::path ros2 = packages.write("prefix/share/new/a.stl", "solid\nendsolid\n");
  const std::string root = packages.path().string();
  const Environment ros("ROS_PACKAGE_PATH",
                        "/no/such/folder::" + root + "/src:" + root + "/single");
  const Environment ament("AMENT_PREFIX_PATH", root + "/prefix");
  for (const auto& [name, file] : {std::pair{"near", direct}, std::pair{"far", nested},
                                   std::pair{"single", itself}, std::pair{"new", ros2}}) {
    const std::string mesh = std::string("<mesh filename=\"package://") + name + "/a.stl\"/>";
    const std::string text = replaced(kGoodArm, "<box size=\"0.4 0.1 0.1\"/>", mesh);
    const RobotDescription robot = read_urdf(urdfs.write("arm.urdf", text));
    CHECK(std::get<MeshGeometry>(robot.links[1].visuals[0].geometry).file == file);
  }
}

TEST_CASE("an origin may be given by a quaternion") {
  // A quarter turn about z, and one about y, where roll and yaw are not unique.
  const TemporaryFolder folder;
  const auto turn = [&](const std::string& quat) {
    const std::string text =
        replaced(kGoodArm, "<axis", "<origin xyz=\"1 2 3\" quat_xyzw=\"" + quat + "\"/><axis");
    return read_urdf(folder.write("arm.urdf", text)).joints[0].X_PJ().R;
  };
  for (const Eigen::Quaterniond& q :
       {Eigen::Quaterniond(1, 0, 0, 1), Eigen::Quaterniond(1, 0, 1, 0),
        Eigen::Quaterniond(1, 0, -1, 0), Eigen::Quaterniond(0.3, -0.4, 0.5, 0.6)}) {
    std::ostringstream text;
    text << q.coeffs().transpose();  // x, y, z, w
    CHECK((turn(text.str()) - q.normalized().toRotationMatrix()).norm() < 1e-15);
  }
}

TEST_CASE("a material is found by name, in the robot or in another visual") {
  const TemporaryFolder folder;
  std::string text = replaced(
      kGoodArm, "<link name=\"base\"/>",
      "<material name=\"red\"><color rgba=\"1 0 0 1\"/></material><link name=\"base\"><visual>"
      "<geometry><sphere radius=\"1\"/></geometry>"
      "<material name=\"blue\"><color rgba=\"0 0 1 0.5\"/></material></visual></link>");
  for (const auto& [name, color] :
       {std::pair{"red", Vector4(1, 0, 0, 1)}, std::pair{"blue", Vector4(0, 0, 1, 0.5)}}) {
    const std::string use = std::string("<material name=\"") + name + "\"/></visual>";
    const RobotDescription robot =
        read_urdf(folder.write("arm.urdf", replaced(text, "    </visual>", use)));
    CHECK(robot.links[1].visuals[0].color == color);
    CHECK(robot.links[1].visuals[0].material == name);
  }
}

TEST_CASE("joints are sorted from the root, those of equal rank in the order of the file") {
  const auto order = [](const std::vector<std::array<const char*, 2>>& links) {  // parent, child
    RobotDescription robot;
    robot.root = "r";
    for (const auto& [parent, child] : links) {
      JointDescription joint;
      joint.name = joint.child = child, joint.parent = parent;
      robot.joints.push_back(joint);
    }
    return joints_from_root(robot);
  };
  using Order = std::vector<std::size_t>;
  CHECK(order({{"b", "c"}, {"a", "b"}, {"r", "a"}}) == Order{2, 1, 0});
  // Repeated sweeps: the second waits for the third, and is then in the next sweep.
  CHECK(order({{"r", "a"}, {"c", "b"}, {"r", "c"}, {"c", "d"}, {"a", "e"}, {"b", "f"}}) ==
        Order{0, 2, 3, 4, 1, 5});
}

}  // namespace
}  // namespace twinarm
