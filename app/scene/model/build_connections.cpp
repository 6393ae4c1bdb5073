// Constraints, springs and couplings: from names to bodies of the model.

#include "app/scene/model/scene_builder.h"
#include "solver/spatial/rotation_to_axis.h"

namespace twinarm {
namespace {

struct ConstraintBuilder {
  SceneModel& scene;
  Kinematics k = kinematics_at(scene.model, scene.start);
  DiagnosticList faults{};

  void build() {
    for (const ConstraintDescription& given : scene.description.constraints) {
      SceneConstraint made;
      made.name = given.name;
      made.line = given.line;
      made.type = given.type;
      if (given.type == ConstraintDescription::Type::gear)
        build_gear(given, made);
      else if (given.motion)
        made.a = child_of(scene, given.a), made.motion = given.motion;
      else
        build_joint(given, made);
      scene.constraints.push_back(std::move(made));
    }
    faults.check();
  }

  // Origin of the body in the world; a fixed one has no body in the model.
  Vector3 origin_of(const std::string& name) const {
    const SceneReference found = *find_reference(scene.description, name);
    if (found.body >= 0) {
      const BodyDescription& body = scene.description.bodies[static_cast<std::size_t>(found.body)];
      if (body.fixed) return body.X_WB.p;
    }
    return k.X_WL[static_cast<std::size_t>(body_of(scene, found))].p;
  }

  void build_springs() {
    for (const SpringDescription& given : scene.description.springs) {
      PointSpring made;
      made.name = given.name;
      made.a.body = body_of(scene, *find_reference(scene.description, given.a));
      made.b.body = body_of(scene, *find_reference(scene.description, given.b));
      if (made.a.body == made.b.body)
        faults.add({scene.description.file.string(), given.line, "spring '" + given.name + "'",
                    "both are the same body", "name two bodies, at most one of them fixed",
                    "scene.same-ends"});
      const auto [p_WA, p_WB] = ends(given, made.b.body);
      made.a.p_L = k.X_WL[static_cast<std::size_t>(made.a.body)].inverse() * p_WA;
      made.b.p_L = k.X_WL[static_cast<std::size_t>(made.b.body)].inverse() * p_WB;
      made.stiffness = given.stiffness;
      made.damping = given.damping;
      made.rest_length = given.rest_length.value_or((p_WB - p_WA).norm());
      made.law = given.law;
      scene.springs.push_back(std::move(made));
    }
    faults.check();
  }

  // The ends of a distance or spring in the world. A single point belongs to the fixed body, else
  // to a; the other end is the origin of the other body.
  template <class Given>
  std::pair<Vector3, Vector3> ends(const Given& given, int b) const {
    const Vector3 origin_a = origin_of(given.a), origin_b = origin_of(given.b);
    if (given.point && !given.point_b && b == 0) return {origin_a, *given.point};
    return {given.point.value_or(origin_a), given.point_b.value_or(origin_b)};
  }

  void fault(const SceneConstraint& made, std::string problem, std::string fix,
             std::string_view code) {
    faults.add({scene.description.file.string(), made.line, "constraint '" + made.name + "'",
                std::move(problem), std::move(fix), code});
  }

  void build_gear(const ConstraintDescription& given, SceneConstraint& made) {
    made.a = child_of(scene, given.a);
    made.b = child_of(scene, given.b);
    made.ratio = given.ratio;
    const auto q = [&](int body) {
      return scene.start.q[scene.model.iq[static_cast<std::size_t>(body)]];
    };
    made.offset = q(made.a) - made.ratio * q(made.b);
  }

  void build_joint(const ConstraintDescription& given, SceneConstraint& made) {
    made.a = body_of(scene, *find_reference(scene.description, given.a));
    made.b = body_of(scene, *find_reference(scene.description, given.b));
    const Pose& X_WA = k.X_WL[static_cast<std::size_t>(made.a)];
    const Pose& X_WB = k.X_WL[static_cast<std::size_t>(made.b)];
    if (made.a == made.b)
      fault(made, "both are the same body", "name two bodies, at most one of them fixed",
            "scene.same-ends");
    if (given.type == ConstraintDescription::Type::distance) {
      const auto [p_WA, p_WB] = ends(given, made.b);
      made.X_AC = X_WA.inverse() * Pose{Matrix3::Identity(), p_WA};
      made.X_BC = X_WB.inverse() * Pose{Matrix3::Identity(), p_WB};
      made.length = (p_WB - p_WA).norm();
      if (!(made.length > 0))
        fault(made, "the two points coincide", "give another point", "scene.same-ends");
      return;
    }
    Pose X_WC;
    X_WC.p = given.point.value_or(X_WA.p);
    if (given.axis) X_WC.R = rotation_taking_z_to(*given.axis);
    if (given.axis_b) {
      const Vector3 z = given.axis->normalized(), y = given.axis_b->normalized();
      if (std::abs(z.dot(y)) > 1e-9)
        fault(made, "axis and axis_b are not perpendicular", "give perpendicular axes",
              "scene.no-direction");
      X_WC.R << y.cross(z), y, z;
    }
    made.X_AC = X_WA.inverse() * X_WC;
    made.X_BC = X_WB.inverse() * X_WC;
  }
};

using Law = CouplingSpec::Type;
using Component = CouplingDescription::Type;

std::size_t robot_named(const SceneDescription& scene, const std::string& name) {
  std::size_t r = 0;
  while (scene.robots[r].name != name) ++r;  // exists: checked by the reader
  return r;
}

// All but the components.
SceneCoupling without_components(const SceneModel& scene, std::size_t index) {
  const CouplingDescription& given = scene.description.couplings[index];
  SceneCoupling made;
  static_cast<CouplingTraits&>(made) = given;
  made.description = index;
  made.coupling = given.name;
  made.first_component = scene.couplings.size();
  made.robot = robot_named(scene.description, given.robot);
  made.target = given.target;
  made.rest = scene.start;
  made.rest.qd.assign(scene.model.nv, 0);
  set_coordinates(scene, made.robot, given.target.q, made.rest);
  if (given.target.is_operator()) made.driven.turned = turned_joints(scene, made.robot);
  if (!given.target.gripper.empty())
    made.driven.gripper = name_in_scene(scene.description, made.robot, given.target.gripper);
  made.driven.gripper_open = given.target.open;
  made.driven.gripper_closed = given.target.closed;
  return made;
}

void add_component(SceneModel& scene, SceneCoupling made, const std::string& part, Component type,
                   const Spring& spring) {
  if (scene.couplings.size() != made.first_component) made.springs.clear();
  if (!part.empty()) made.name += "/" + part;
  made.type = type;
  made.spring = spring;
  made.spring.name = made.name;
  scene.couplings.push_back(std::move(made));
}

void add_six_dimensions(SceneModel& scene, SceneCoupling made, const Spring& spring) {
  made.springs = {spring};
  add_component(scene, made, "force", Component::linear, spring);
  Spring rotational = spring;
  rotational.k = spring.k_rotational, rotational.b = spring.b_rotational;
  add_component(scene, made, "couple", Component::torsional, rotational);
}

void add_god_object(SceneModel& scene, SceneCoupling made, DiagnosticList& faults) {
  const auto [first, last] = scene.bodies_of_robot(made.robot);
  made.springs = god_object_joints(scene.model, first, last);
  made.measure = SpringSpace::joint;
  for (const Spring& joint : made.springs)
    add_component(scene, made, scene.model.joint_name[static_cast<std::size_t>(joint.body)],
                  Component::torsional, joint);
  if (made.springs.empty())
    faults.add({scene.description.file.string(), made.line, "coupling '" + made.name + "'",
                "its robot has no joint to move", "name a robot with joints",
                "scene.nothing-to-drive"});
}

}  // namespace

void build_constraints(SceneModel& scene) {
  ConstraintBuilder builder{scene};
  builder.build();
  builder.build_springs();
}

std::vector<std::string> turned_joints(const SceneModel& scene, std::size_t robot) {
  std::vector<std::string> names;
  const std::string prefix = name_in_scene(scene.description, robot, "");
  for (const JointDescription& joint : scene.description.robots[robot].description.joints)
    if (joint.dofs() == 1 && !joint.mimic && names.size() < 3) names.push_back(prefix + joint.name);
  return names;
}

void build_couplings(SceneModel& scene) {
  DiagnosticList faults;
  for (std::size_t i = 0; i < scene.description.couplings.size(); ++i) {
    const CouplingDescription& given = scene.description.couplings[i];
    SceneCoupling made = without_components(scene, i);
    if (given.law == Law::god_object) {
      add_god_object(scene, std::move(made), faults);
      continue;
    }
    const int body = body_of(scene, {-1, static_cast<int>(made.robot), given.link});
    if (given.law == Law::weld) {
      add_six_dimensions(
          scene, std::move(made),
          weld_spring(given.name, scene.model, scene.start, body, given.point, given.reference));
      continue;
    }
    const Spring spring{given.name,
                        body,
                        given.point,
                        given.stiffness,
                        given.damping,
                        given.rotational_stiffness,
                        given.rotational_damping};
    made.springs = {spring};
    if (given.law == Law::bushing)
      add_six_dimensions(scene, std::move(made), spring);
    else
      add_component(scene, std::move(made), "", given.type, spring);
  }
  faults.check();
}

bool SceneCoupling::has_motion_of(const SceneCoupling& other) const {
  const CouplingTarget& its = other.target;
  return robot == other.robot && target.kind == its.kind && target.trace == its.trace &&
         target.seed == its.seed && target.ranges == its.ranges &&
         target.duration == its.duration && delay == other.delay && speed == other.speed;
}

bool SceneCoupling::needs_semi_implicit() const {
  return discretization != Discretization::explicit_ || law == CouplingSpec::Type::weld ||
         facts_of(law, printed).discretizations == CouplingFacts::Discretizations::own;
}

SceneCoupling::ThirdRow SceneCoupling::third_row() const {
  if (!facts_of(law, printed).is_spring_damper) return ThirdRow::drive;
  if (needs_semi_implicit()) return ThirdRow::implicit;
  return printed ? ThirdRow::as_printed : ThirdRow::none;
}

}  // namespace twinarm
