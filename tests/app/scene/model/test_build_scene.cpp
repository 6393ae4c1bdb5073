// From the description to the solver's model: masses, inertias, states, surfaces, who touches whom.
#include <Eigen/Geometry>
#include <numbers>

#include "app/scene/model/scene_model.h"
#include "collision/import/urdf/urdf.h"
#include "coupling/analysis/prediction.h"
#include "solver/dynamics/energy_momentum.h"
#include "solver/stepping/simulation.h"
#include "tests/app/scene/model/helpers.h"

namespace twinarm {
namespace {

constexpr double kPi = std::numbers::pi;

int body(const SceneModel& scene, const std::string& name) {
  const int found = scene.model.find_body(name);
  REQUIRE(found > 0);
  return found;
}

// Spatial inertia of a body as the model has it: mass, com, inertia about the com.
struct Inertial {
  double mass;
  Vector3 com;
  Matrix3 inertia;
};
Inertial inertial_of(const SceneModel& scene, const std::string& name) {
  // A free body at the identity: M = [I_o, m [c]x; m [c]x^T, m 1] in (w, v).
  const Model<double>& model = scene.model;
  const State<double> still(model);
  const Eigen::MatrixXd M = mass_matrix(model, still);
  const auto iv = static_cast<Eigen::Index>(model.iv[static_cast<std::size_t>(body(scene, name))]);
  Inertial solid;
  solid.mass = M(iv + 3, iv + 3);
  const Matrix3 mc = M.block<3, 3>(iv, iv + 3);
  solid.com = Vector3(mc(2, 1), mc(0, 2), mc(1, 0)) / solid.mass;
  const Vector3& c = solid.com;
  solid.inertia = M.block<3, 3>(iv, iv) -
                  solid.mass * (c.squaredNorm() * Matrix3::Identity() - c * c.transpose());
  return solid;
}
Matrix3 diagonal(double x, double y, double z) {
  return Vector3(x, y, z).asDiagonal();
}

TEST_CASE("scene: a free body has the inertia of its uniform solid, scaled to its mass") {
  struct Case {
    const char* shape;
    double volume;
    Matrix3 per_mass;
  };
  const double r = 0.3, l = 0.8;
  // Of the capsule by slices: dI = rho pi s^2 (s^2/4 + z^2) dz, s(z) the radius at height z.
  double volume = 0, across = 0, along = 0;
  const int n = 200000;
  for (int i = 0; i < n; ++i) {
    const double dz = (l + 2 * r) / n, z = (i + 0.5) * dz - l / 2 - r;
    const double over = std::max(0.0, std::abs(z) - l / 2), s2 = r * r - over * over;
    volume += kPi * s2 * dz;
    across += kPi * s2 * (s2 / 4 + z * z) * dz;
    along += kPi * s2 * s2 / 2 * dz;
  }
  for (const Case& c :
       {Case{"box = { size = [0.2, 0.4, 0.6] }", 0.2 * 0.4 * 0.6,
             diagonal(0.16 + 0.36, 0.04 + 0.36, 0.04 + 0.16) / 12},
        Case{"sphere = { radius = 0.3 }", 4.0 / 3 * kPi * r * r * r,
             0.4 * r * r * Matrix3::Identity()},
        Case{"cylinder = { radius = 0.3, length = 0.8 }", kPi * r * r * l,
             diagonal(r * r / 4 + l * l / 12, r * r / 4 + l * l / 12, r * r / 2)},
        Case{"ellipsoid = { semi_axes = [1, 2, 3] }", 8 * kPi, diagonal(13, 10, 5) / 5},
        Case{"capsule = { radius = 0.3, length = 0.8 }", volume,
             diagonal(across, across, along) / volume}}) {
    INFO(c.shape);
    const std::string head = "[[body]]\nname = 'b'\nshape = { " + std::string(c.shape) + " }\n";
    const double tolerance = std::string(c.shape).find("caps") == 0 ? 1e-9 : 1e-14;
    const Inertial by_mass = inertial_of(built(head + "mass = 2.5\n"), "b");
    CHECK(by_mass.mass == doctest::Approx(2.5).epsilon(1e-15));
    CHECK(close(by_mass.inertia, 2.5 * c.per_mass, tolerance));
    CHECK(by_mass.com.isZero(1e-15));
    const Inertial by_density = inertial_of(built(head + "density = 700\n"), "b");
    CHECK(by_density.mass == doctest::Approx(700 * c.volume).epsilon(tolerance));
    CHECK(close(by_density.inertia / by_density.mass, c.per_mass, tolerance));
  }
}

TEST_CASE("scene: a mesh is the solid of its hull, in metres after its scale") {
  // A tetrahedron of legs a: com a/4, I_xx about the com = m a^2 3/40, I_xy = m a^2 / 80.
  const TemporaryFolder folder;
  folder.write("corner.obj",
               "v 0 0 0\nv 1000 0 0\nv 0 1000 0\nv 0 0 1000\n"
               "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const auto file = folder.write("test.toml",
                                 "[[body]]\nname = 'b'\nmass = 3\n"
                                 "shape = { mesh = { file = 'corner.obj', scale = 0.001 } }\n");
  const Inertial solid = inertial_of(build_scene(read_scene(file)), "b");
  CHECK(close(solid.com, Vector3::Constant(0.25), 1e-6));
  Matrix3 per_mass = Matrix3::Constant(1.0 / 80);
  per_mass.diagonal().setConstant(3.0 / 40);
  CHECK(close(solid.inertia, 3 * per_mass, 1e-6));
}

TEST_CASE("scene: a given inertia and centre of mass are taken as they are") {
  const SceneModel scene = built(
      "[[body]]\nname = 'b'\nshape.sphere.radius = 1\nmass = 2\ncom = [0.1, 0.2, 0.3]\n"
      "inertia = [0.4, 0.5, 0.6, 0.01, 0.02, 0.03]\nposition = [1, 2, 3]\n");
  const Inertial solid = inertial_of(scene, "b");
  CHECK(close(solid.com, Vector3(0.1, 0.2, 0.3)));
  Matrix3 I;
  I << 0.4, 0.01, 0.02, 0.01, 0.5, 0.03, 0.02, 0.03, 0.6;
  CHECK(close(solid.inertia, I));
  // The potential energy is that of the centre of mass, not of the origin.
  CHECK(potential_energy(scene.model, scene.start) == doctest::Approx(2 * 9.81 * 3.3));
}

TEST_CASE("scene: velocities of a free body are those of its origin, in world axes") {
  const SceneModel scene = built(
      "[[body]]\nname = 'b'\nshape.box.size = [1, 2, 3]\nmass = 2\nposition = [1, 2, 3]\n"
      "orientation = [0.5, 0.5, -0.5, 0.5]\nlinear_velocity = [1, -2, 3]\n"
      "angular_velocity = [4, 5, -6]\ncom = [0.1, 0, 0]\ninertia = [1, 1, 1, 0, 0, 0]\n");
  Kinematics k(scene.model);
  forward_kinematics(scene.model, scene.start, k);
  const int b = body(scene, "b");
  CHECK(close(k.X_WL[b].p, Vector3(1, 2, 3)));
  CHECK(close(k.X_WL[b].R, Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5).toRotationMatrix()));
  CHECK(close(k.v_WLo[b], Vector3(1, -2, 3)));
  CHECK(close(k.w_WL[b], Vector3(4, 5, -6)));
}

TEST_CASE("scene: a body with prescribed motion follows it and has no weight") {
  SceneModel scene = built(
      "[[body]]\nname = 'table'\nshape.cylinder = { radius = 1, length = 0.1 }\n"
      "position = [1, 0, 0]\norientation = [0.8, 0, 0.6, 0]\n"
      "motion = { linear = [0.1, 0.2, 0.3], angular = [0, 0, 2] }\n");
  REQUIRE(scene.motions.size() == 1);
  Simulation simulation(scene.model, scene.start);
  const Pose at_first = simulation.kinematics().X_WL[1];
  CHECK(close(at_first.p, Vector3(1, 0, 0)));
  simulation.prescribe(scene.motions[0].body, scene.motions[0].law);
  simulation.set_integrator(Integrator::rk4);
  for (int i = 0; i < 10; ++i) simulation.step(0.1);
  const Kinematics& k = simulation.kinematics();
  CHECK(close(k.X_WL[1].p, Vector3(1.1, 0.2, 0.3)));
  CHECK(close(k.X_WL[1].R, Eigen::AngleAxisd(2, Vector3::UnitZ()).toRotationMatrix() * at_first.R));
  CHECK(close(k.v_WLo[1], Vector3(0.1, 0.2, 0.3)));
  CHECK(close(k.w_WL[1], Vector3(0, 0, 2)));
  CHECK(kinetic_energy(scene.model, simulation.state()) == 0);
}

TEST_CASE("scene: several robots have their poses, each joint with its robot's name") {
  const std::string model = "model = 'robots/findings_set0/findings_set0.urdf'\n";
  const SceneModel scene = built(
      "gravity = [0, 0, -1]\n[[robot]]\nname = 'left'\n" + model +
      "position = [1, 2, 3]\nq = { joint1 = 0.3 }\n[[robot]]\nname = 'right'\n" + model +
      "orientation = [0.6, 0, 0, 0.8]\nq = { joint1 = 0.3, joint2 = -0.5 }\nqd = { joint2 = 2 }\n");
  const Model<double>& model_of = scene.model;
  CHECK(model_of.gravity.z == -1);
  CHECK(scene.robot_bodies == 6);
  const int joint = model_of.find_joint("right/joint2");
  REQUIRE(joint > 0);
  CHECK(scene.start.q[model_of.iq[static_cast<std::size_t>(joint)]] == -0.5);
  CHECK(scene.start.qd[model_of.iv[static_cast<std::size_t>(joint)]] == 2);

  // A robot alone, moved as a whole, is the oracle for the positions.
  const SceneModel alone =
      built("[[robot]]\nname = 'r'\n" + model + "q = { joint1 = 0.3, joint2 = -0.5 }\n");
  CHECK(alone.model.find_joint("joint1") > 0);
  Kinematics k(model_of), k_alone(alone.model);
  forward_kinematics(model_of, scene.start, k);
  forward_kinematics(alone.model, alone.start, k_alone);
  const Matrix3 R = Eigen::Quaterniond(0.6, 0, 0, 0.8).toRotationMatrix();
  CHECK(close(k.X_WL[body(scene, "right/arm2")].p, R * k_alone.X_WL[body(alone, "arm2")].p));
  CHECK(close(k.X_WL[body(scene, "left/arm1")].p,
              Vector3(1, 2, 3) + k_alone.X_WL[body(alone, "arm1")].p));
}

TEST_CASE("scene: a floating robot is placed by its position and velocity") {
  const SceneModel scene = built(
      "[[robot]]\nname = 'r'\nmodel = 'robots/s103/s103.urdf'\n"
      "base = 'floating'\nposition = [1, 2, 3]\norientation = [0.6, 0.8, 0, 0]\n"
      "linear_velocity = [4, 5, 6]\nangular_velocity = [1, 2, 3]\n");
  Kinematics k(scene.model);
  forward_kinematics(scene.model, scene.start, k);
  CHECK(scene.model.joint[1] == JointType::free);
  CHECK(close(k.X_WL[1].p, Vector3(1, 2, 3)));
  CHECK(close(k.v_WLo[1], Vector3(4, 5, 6)));
  CHECK(close(k.w_WL[1], Vector3(1, 2, 3)));
}

TEST_CASE(
    "scene: a pair has the mean of frictions and the product of restitutions, or its override") {
  const std::string shape = "shape.box.size = [1, 1, 1]\nfixed = ";
  const SceneModel scene = built(
      "[[body]]\nname = 'a'\nmass = 1\n" + shape +
      "false\nfriction = 0.4\nrestitution = 0.5\n"
      "rolling_friction = 0.01\n"
      "[[body]]\nname = 'b'\n" +
      shape +
      "true\nfriction = 0.9\nrestitution = 0.8\n"
      "[[body]]\nname = 'c'\nmass = 1\n" +
      shape +
      "false\n"
      "[[pair]]\na = 'b'\nb = 'c'\nfriction = 0.7\n[[pair]]\na = 'a'\nb = 'c'\ncollide = false\n");
  REQUIRE(scene.geometries.size() == 3);
  const ContactSurface ab = scene.surface_of_pair(0, 1);
  CHECK(ab.friction == doctest::Approx(0.6).epsilon(1e-15));
  CHECK(ab.restitution == doctest::Approx(0.4).epsilon(1e-15));
  CHECK(ab.rolling_friction == 0.01);
  CHECK(scene.surface_of_pair(2, 1).friction == 0.7);
  CHECK(scene.surface_of_pair(1, 2).restitution == 0);
  CHECK(scene.is_apart(2, 0));
  CHECK(!scene.is_apart(0, 1));
  CHECK(!scene.is_apart(1, 2));
  CHECK(scene.may_touch());
}

TEST_CASE("scene: the springs of a pair are in series, unless overridden") {
  const std::string shape = "mass = 1\nshape.sphere.radius = 1\n";
  const SceneModel scene =
      built("[[body]]\nname = 'a'\n" + shape +
            "stiffness = 3e5\ndissipation = 1\n[[body]]\nname = 'b'\n" + shape +
            "stiffness = 6e5\ndissipation = 4\n[[body]]\nname = 'c'\n" + shape +
            "[[pair]]\na = 'c'\nb = 'a'\nstiffness = 7\n" +
            "[[pair]]\na = 'b'\nb = 'c'\ndissipation = 0\n");
  const ContactSurface ab = scene.surface_of_pair(0, 1);
  CHECK(ab.stiffness == doctest::Approx(2e5).epsilon(1e-15));
  CHECK(ab.dissipation == doctest::Approx((2 * 1 + 1 * 4) / 3.0).epsilon(1e-15));
  const ContactSurface ac = scene.surface_of_pair(0, 2);  // of the default 1e6 N/m and 1 s/m
  CHECK(ac.stiffness == 7);
  CHECK(ac.dissipation == doctest::Approx(1).epsilon(1e-15));
  const ContactSurface bc = scene.surface_of_pair(1, 2);
  CHECK(bc.stiffness == doctest::Approx(3.75e5).epsilon(1e-15));
  CHECK(bc.dissipation == 0);
}

TEST_CASE("scene: of several pairs of the same bodies the last value of each key decides") {
  const std::string shape = "mass = 1\nshape.sphere.radius = 1\n";
  const SceneModel scene =
      built("[[body]]\nname = 'a'\n" + shape + "[[body]]\nname = 'b'\n" + shape +
            "[[pair]]\na = 'a'\nb = 'b'\nfriction = 0.1\nrestitution = 0.3\ncollide = false\n" +
            "[[pair]]\na = 'b'\nb = 'a'\nfriction = 0.2\ncollide = true\n");
  CHECK(scene.surface_of_pair(0, 1).friction == 0.2);
  CHECK(scene.surface_of_pair(1, 0).restitution == 0.3);
  CHECK(!scene.is_apart(0, 1));
}

TEST_CASE("scene: no contacts of neighbours, one group, constrained or immovable bodies") {
  const std::string ball = "mass = 1\nshape.sphere.radius = 0.1\n";
  const auto name = [](const char* n) { return "[[body]]\nname = '" + std::string(n) + "'\n"; };
  const std::string fixed = "fixed = true\nshape.sphere.radius = 0.1\n";
  CHECK(!built(name("a") + fixed + name("b") + fixed).may_touch());
  CHECK(built(name("a") + fixed + name("b") + ball).may_touch());
  CHECK(!built(name("a") + ball + "group = 1\n" + name("b") + ball + "group = 1\n").may_touch());
  CHECK(built(name("a") + ball + "group = 1\n" + name("b") + ball + "group = 2\n").may_touch());
  const std::string tie = "[[constraint]]\na = 'a'\nb = 'b'\npoint = [0, 0, 0]\ntype = ";
  CHECK(!built(name("a") + ball + name("b") + ball + tie + "'ball'\n").may_touch());
  CHECK(built(name("a") + ball + name("b") + ball + "position = [1, 0, 0]\n" + tie + "'distance'\n")
            .may_touch());
  CHECK(built(name("a") + ball + name("b") + ball + tie +
              "'ball'\n[[pair]]\na = 'a'\nb = 'b'\ncollide = true\n")
            .may_touch());

  const std::string arm = "[[robot]]\nname = 'r'\nmodel = 'robots/s103/s103.urdf'\n";
  const SceneModel s103 = built(arm + name("floor") + fixed);
  const auto apart = [&](const std::string& a, const std::string& b) {
    bool all = true;
    for (int i = 0; i < static_cast<int>(s103.geometries.size()); ++i)
      for (int j = i + 1; j < static_cast<int>(s103.geometries.size()); ++j) {
        const auto &p = s103.geometries[static_cast<std::size_t>(i)].name,
                   &q = s103.geometries[static_cast<std::size_t>(j)].name;
        if (!((p == a && q == b) || (p == b && q == a))) continue;
        all = all && s103.is_apart(i, j);
      }
    return all;
  };
  CHECK(apart("base", "arm1"));
  CHECK(apart("arm1", "arm2"));
  CHECK(apart("base", "floor"));
  CHECK(!apart("arm1", "floor"));
  CHECK(!apart("base", "arm2"));
  CHECK(built(arm + "collide = false\n").geometries.empty());
}

TEST_CASE("scene: errors of the model are reported with the line of its robot") {
  const TemporaryFolder folder;
  folder.write("light.urdf",
               "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='continuous'>"
               "<parent link='a'/><child link='b'/></joint></robot>");
  const auto file =
      folder.write("test.toml", "step = 1\n[[robot]]\nname = 'r'\nmodel = 'light.urdf'\n");
  const std::vector<Diagnostic> faults = faults_of([&] { build_scene(read_scene(file)); });
  REQUIRE(faults.size() == 1);
  CHECK(to_string(faults[0]).find("light.urdf") != std::string::npos);
}

}  // namespace
}  // namespace twinarm
