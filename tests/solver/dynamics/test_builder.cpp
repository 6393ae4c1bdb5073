// Model builder: result and rejected input, all errors at once.
#include "solver/dynamics/model_builder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/kinematics.h"
#include "solver/model/convert_model.h"
#include "solver/spatial/batch.h"

using namespace twinarm;

namespace {

const Vector3 kAxis = Vector3::UnitZ();
const BodyInertia kBody{2, {0.1, 0, 0}, Vector3(0.3, 0.2, 0.4).asDiagonal()};
const BodyInertia kNothing;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// A valid builder with one body.
ModelBuilder started() {
  ModelBuilder builder;
  builder.add_body("arm", 0, "shoulder", JointType::revolute, {}, kAxis, kBody);
  return builder;
}
std::vector<Diagnostic> faults_of(const ModelBuilder& builder) {
  try {
    builder.build();
  } catch (const InputError& error) {
    return error.faults();
  }
  return {};
}
bool tells(const std::vector<Diagnostic>& faults, const std::string& where,
           const std::string& words) {
  return std::any_of(faults.begin(), faults.end(), [&](const Diagnostic& fault) {
    return fault.where.find(where) != std::string::npos &&
           (fault.problem + "; " + fault.fix).find(words) != std::string::npos;
  });
}
bool only_fault(const ModelBuilder& builder, const std::string& where, const std::string& words) {
  const std::vector<Diagnostic> faults = faults_of(builder);
  std::string all;
  for (const Diagnostic& fault : faults) all += to_string(fault) + "\n";
  INFO(all);
  CHECK(faults.size() == 1);
  return faults.size() == 1 && tells(faults, where, words);
}
ModelBuilder with(const BodyInertia& inertia, const JointProperties& properties = {},
                  JointType type = JointType::revolute, const Vector3& axis = kAxis) {
  ModelBuilder builder = started();
  builder.add_body("hand", 1, "wrist", type, {}, axis, inertia, properties);
  return builder;
}

}  // namespace

TEST_CASE("a parent must be a body that was added before") {
  for (const int parent : {-1, 2, 7}) {
    ModelBuilder builder = started();
    builder.add_body("hand", parent, "wrist", JointType::revolute, {}, kAxis, kBody);
    CHECK(only_fault(builder, "link 'hand'", "parent"));
  }
}

TEST_CASE("duplicate link and joint names are rejected") {
  ModelBuilder same_link = started();
  same_link.add_body("arm", 1, "wrist", JointType::revolute, {}, kAxis, kBody);
  CHECK(only_fault(same_link, "link 'arm'", "duplicate"));
  ModelBuilder same_joint = started();
  same_joint.add_body("hand", 1, "shoulder", JointType::revolute, {}, kAxis, kBody);
  CHECK(only_fault(same_joint, "joint 'shoulder'", "duplicate"));
}

TEST_CASE("a link named world is found before the base") {
  ModelBuilder builder;
  builder.add_body("world", 0, "stand", JointType::fixed, {}, kAxis, kBody);
  builder.add_body("arm", 1, "shoulder", JointType::revolute, {}, kAxis, kBody);
  const Model<double> model = builder.build();
  CHECK(model.find_body("world") == 1);
  CHECK(model.find_body("arm") == 2);
  CHECK(model.find_body("leg") == -1);
  CHECK(model.find_joint("shoulder") == 2);
  CHECK(model.find_joint("") == -1);
  CHECK(started().build().find_body("world") == 0);
}

TEST_CASE("bodies and joints are found by name in any order, also in a converted model") {
  ModelBuilder builder;
  const auto name = [](int i) { return std::to_string(i * 37 % 101); };
  for (int i = 1; i <= 100; ++i)
    builder.add_body(name(i), i - 1, "to " + name(101 - i), JointType::revolute, {}, kAxis, kBody);
  const Model<double> model = builder.build();
  const auto converted = convert<Batch<4>>(model);
  for (int i = 1; i <= 100; ++i) {
    CHECK(model.find_body(name(i)) == i);
    CHECK(model.find_joint("to " + name(101 - i)) == i);
    CHECK(converted.find_body(name(i)) == i);
    CHECK(converted.find_joint(name(i)) == -1);
  }
}

TEST_CASE("joints with an axis reject a zero or non-finite axis") {
  for (const JointType type : all_joint_types)
    for (const Vector3& axis : {Vector3(0, 0, 0), Vector3(kNaN, 0, 1), Vector3(INFINITY, 0, 0)}) {
      CAPTURE(std::string(name_of(type)));
      const bool has_axis = type == JointType::revolute || type == JointType::prismatic ||
                            type == JointType::screw || type == JointType::cylindrical ||
                            type == JointType::universal || type == JointType::planar;
      const ModelBuilder builder = with(kBody, {}, type, axis);
      if (has_axis)
        CHECK(only_fault(builder, "joint 'wrist'", "axis is zero"));
      else
        CHECK(faults_of(builder).empty());
    }
}

TEST_CASE("masses and inertias must be finite, masses not negative") {
  BodyInertia body = kBody;
  body.mass = -3;
  CHECK(only_fault(with(body), "link 'hand'", "mass is -3"));
  body = kBody;
  body.mass = kNaN;
  CHECK(only_fault(with(body), "link 'hand'", "not a finite number"));
  body = kBody;
  body.com.y() = INFINITY;
  CHECK(only_fault(with(body), "link 'hand'", "not a finite number"));
  body = kBody;
  body.inertia(1, 2) = kNaN;
  CHECK(only_fault(with(body), "link 'hand'", "not a finite number"));
}

TEST_CASE("armature, damping and Coulomb friction must not be negative, pitch must be finite") {
  const auto set = [](double JointProperties::*member, double value) {
    JointProperties properties;
    properties.*member = value;
    return with(kBody, properties, JointType::screw);
  };
  for (const double bad : {-1.0, kNaN, HUGE_VAL}) {
    CHECK(only_fault(set(&JointProperties::armature, bad), "joint 'wrist'", "armature"));
    CHECK(only_fault(set(&JointProperties::damping, bad), "joint 'wrist'", "damping"));
    CHECK(only_fault(set(&JointProperties::coulomb_plus, bad), "joint 'wrist'", "Coulomb"));
    CHECK(only_fault(set(&JointProperties::coulomb_minus, bad), "joint 'wrist'", "Coulomb"));
  }
  CHECK(only_fault(set(&JointProperties::pitch, kNaN), "joint 'wrist'", "pitch"));
  CHECK(faults_of(set(&JointProperties::pitch, -0.1)).empty());
}

TEST_CASE("all errors are reported at once") {
  BodyInertia negative = kBody;
  negative.mass = -1;
  JointProperties bad;
  bad.armature = -1;
  bad.damping = kNaN;
  ModelBuilder builder = started();
  builder.add_body("arm", 5, "shoulder", JointType::revolute, {}, Vector3::Zero(), negative, bad);
  const auto faults = faults_of(builder);
  CHECK(faults.size() == 7);  // parent, two names, axis, mass, armature, damping
}

TEST_CASE("a joint with zero articulated inertia is rejected by name") {
  for (const JointType type : all_joint_types) {
    CAPTURE(std::string(name_of(type)));
    const ModelBuilder tip = with(kNothing, {}, type);
    if (type == JointType::fixed || type == JointType::prescribed)
      CHECK(faults_of(tip).empty());
    else
      CHECK(only_fault(tip, "joint 'wrist'", "articulated inertia"));
  }
  // A point mass has no inertia about an axis through it.
  const BodyInertia point{1, Vector3::Zero(), Matrix3::Zero()}, below{1, -kAxis, Matrix3::Zero()};
  CHECK(only_fault(with(point), "joint 'wrist'", "articulated inertia"));
  CHECK(only_fault(with(below), "joint 'wrist'", "articulated inertia"));
  CHECK(only_fault(with(below, {}, JointType::spherical), "joint 'wrist'", "articulated inertia"));
  CHECK(only_fault(with(below, {}, JointType::free), "joint 'wrist'", "articulated inertia"));
  CHECK(faults_of(with(point, {}, JointType::prismatic)).empty());
  CHECK(faults_of(with(below, {}, JointType::universal, Vector3::UnitX())).empty());
  JointProperties geared;
  geared.armature = 0.01;
  CHECK(faults_of(with(kNothing, geared)).empty());
}

TEST_CASE("massless links may have children, except between two collinear revolute joints") {
  ModelBuilder wrist = started();  // three revolute joints, only the last link has inertia
  wrist.add_body("a", 1, "roll", JointType::revolute, {}, Vector3::UnitX(), kNothing);
  wrist.add_body("b", 2, "pitch", JointType::revolute, {}, Vector3::UnitY(), kNothing);
  wrist.add_body("c", 3, "yaw", JointType::revolute, {}, kAxis, kBody);
  CHECK(faults_of(wrist).empty());
  ModelBuilder doubled = started();
  doubled.add_body("a", 1, "inner", JointType::revolute, {}, kAxis, kNothing);
  doubled.add_body("b", 2, "outer", JointType::revolute, {}, kAxis, kBody);
  CHECK(tells(faults_of(doubled), "joint 'inner'", "articulated inertia"));
  ModelBuilder far = started();  // parallel axes at a distance are valid
  far.add_body("a", 1, "inner", JointType::revolute, {}, kAxis, kNothing);
  far.add_body("b", 2, "outer", JointType::revolute, {Matrix3::Identity(), {0.3, 0, 0}}, kAxis,
               kBody);
  CHECK(faults_of(far).empty());
}

TEST_CASE("very small and large bodies and inconsistent inertias are accepted") {
  BodyInertia dust = kBody, planet = kBody;
  dust.mass *= 1e-9;
  dust.inertia *= 1e-15;
  dust.com *= 1e-3;
  planet.mass *= 1e9;
  planet.inertia *= 1e9;
  CHECK(faults_of(with(dust)).empty());
  CHECK(faults_of(with(planet)).empty());
  // Published PUMA links 1 and 3: inconsistent inertia, but positive about the joints.
  const BodyInertia link1{0, Vector3::Zero(), Vector3(0, 0.35, 0).asDiagonal()};
  CHECK(faults_of(with(link1, {}, JointType::revolute, Vector3::UnitY())).empty());
  const BodyInertia link3{4.8, {-0.02, -0.014, 0.07}, Vector3(0.066, 0.086, 0.0125).asDiagonal()};
  CHECK(faults_of(with(link3)).empty());
}

TEST_CASE("the body's z is the joint's axis, by the shortest rotation, for any direction") {
  for (const Vector3& axis :
       {Vector3(0, 0, 1), Vector3(0, 0, -1), Vector3(0, 0, 5), Vector3(1, 0, 0), Vector3(0, -2, 0),
        Vector3(1, 2, 3), Vector3(-1, 1, -3), Vector3(1e-3, 0, -1), Vector3(1e-6, 0, -1),
        Vector3(2e-6, 6e-7, -1), Vector3(0, 1e-9, -1), Vector3(1e-200, 0, -1),
        Vector3(1e-8, 1e-8, 1)}) {
    CAPTURE(axis.transpose());
    const Model<double> model = with(kBody, {}, JointType::revolute, axis).build();
    const Matrix3 R_LB = to_eigen(model.R_BL[2]).transpose();
    const Vector3 a = axis.normalized();
    CHECK((R_LB * kAxis - a).norm() < 4e-16);
    CHECK((R_LB.transpose() * R_LB - Matrix3::Identity()).norm() < 1e-15);
    CHECK(R_LB.determinant() == doctest::Approx(1).epsilon(1e-15));
    // Shortest: the rotation's axis is normal to z and a, so z x a is invariant.
    const Vector3 normal = kAxis.cross(a);
    CHECK((R_LB * normal - normal).norm() <= 1e-15 * normal.norm() + 1e-300);
  }
  const Model<double> along = started().build();
  CHECK(to_eigen(along.R_BL[1]) == Matrix3(Matrix3::Identity()));
  const Model<double> against = with(kBody, {}, JointType::revolute, -kAxis).build();
  CHECK(to_eigen(against.R_BL[2]) == Matrix3(Vector3(1, -1, -1).asDiagonal()));
}

TEST_CASE("joint properties apply to each dof; pitch applies to screw joints only") {
  JointProperties p;
  p.pitch = 0.2, p.armature = 1, p.damping = 2, p.coulomb_plus = 3, p.coulomb_minus = 4;
  for (const JointType type : all_joint_types) {
    const Model<double> model = with(kBody, p, type).build();
    CHECK(model.dofs(2) == model.nv - 1);
    CHECK(model.pitch[2] == (type == JointType::screw ? 0.2 : 0));
    CHECK(model.armature[0] == 0);
    for (std::size_t k = 1; k < model.nv; ++k) {
      CHECK(model.armature[k] == 1);
      CHECK(model.damping[k] == 2);
      CHECK(model.coulomb_plus[k] == 3);
      CHECK(model.coulomb_minus[k] == 4);
    }
  }
}

namespace {

ModelBuilder four_revolutes() {
  ModelBuilder builder;
  for (int i = 1; i <= 4; ++i) {
    const std::string n = std::to_string(i);
    builder.add_body("link" + n, i - 1, "j" + n,
                     i == 4 ? JointType::universal : JointType::revolute, {}, Vector3(1, 0, i),
                     kBody);
  }
  return builder;
}

}  // namespace

TEST_CASE("chains of mimic joints are resolved to the independent joint") {
  ModelBuilder builder = four_revolutes();
  builder.add_mimic("j3", "j2", 2, 0.5);
  builder.add_mimic("j2", "j1", -3, 0.1);
  const Model<double> model = builder.build();
  REQUIRE(model.mimics.size() == 2);
  const Mimic& third = model.mimics[0];  // 2 (-3 q1 + 0.1) + 0.5
  CHECK(third.follower == 2);
  CHECK(third.leader == 0);
  CHECK(third.follower_q == 2);
  CHECK(third.leader_q == 0);
  CHECK(third.ratio == -6);
  CHECK(third.offset == doctest::Approx(0.7).epsilon(1e-15));
  CHECK(model.mimics[1].leader == 0);
  CHECK(model.mimics[1].ratio == -3);
}

TEST_CASE("mimic joints need an existing mimicked joint, one dof each, and no cycle") {
  const auto faults = [](const std::string& follower, const std::string& leader) {
    ModelBuilder builder = four_revolutes();
    builder.add_mimic(follower, leader, 1, 0);
    return faults_of(builder);
  };
  CHECK(tells(faults("j2", "missing"), "joint 'j2'", "'missing'"));
  CHECK(tells(faults("missing", "j2"), "joint 'missing'", "must exist"));
  CHECK(tells(faults("j2", "j4"), "joint 'j2'", "one degree of freedom"));
  CHECK(tells(faults("j4", "j2"), "joint 'j4'", "one degree of freedom"));
  CHECK(tells(faults("j2", "j2"), "joint 'j2'", "cyclic"));

  ModelBuilder circle = four_revolutes();
  circle.add_mimic("j1", "j2", 1, 0);
  circle.add_mimic("j2", "j3", 1, 0);
  circle.add_mimic("j3", "j1", 1, 0);
  CHECK(tells(faults_of(circle), "joint 'j1'", "cyclic"));
  ModelBuilder beside = four_revolutes();  // leads into a cycle without being in it
  beside.add_mimic("j1", "j2", 1, 0);
  beside.add_mimic("j2", "j3", 1, 0);
  beside.add_mimic("j3", "j2", 1, 0);
  CHECK_FALSE(faults_of(beside).empty());
}
