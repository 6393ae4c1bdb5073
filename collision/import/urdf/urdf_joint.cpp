// The <joint> of a URDF.
#include "collision/import/urdf/urdf_parts.h"

#include <cmath>

#include "collision/import/robot/robot_check.h"
#include "solver/support/number_text.h"

namespace twinarm {

namespace {

using Type = JointDescription::Type;

// Joint types beyond URDF are given by <twinarm type="">; <joint type=""> is then for other
// programs.
void read_type(const XmlElement& element, const std::string& where, JointDescription& joint,
               UrdfSource& source) {
  const std::string type = source.text(element, "type", where);
  Type plain{};
  const bool known = joint_type_from(type, plain);
  if (known && !is_urdf_type(plain))
    source.fault(element.line, where, "URDF has no joint type '" + type + "'",
                 "write type=\"" + std::string(to_string(urdf_type_of(plain, false))) +
                     "\" for other programs, and inside <twinarm type=\"" + type + "\"/>",
                 "urdf.joint-type");
  else if (!known && !type.empty())
    source.fault(element.line, where, "joint type '" + type + "' is not supported",
                 supported_joints(), "urdf.joint-type");
  joint.type = plain;

  const XmlElement* extension = element.child("twinarm");
  const char* name = extension ? extension->value("type") : nullptr;
  if (!name) return;
  Type extended{};
  if (joint_type_from(name, extended) && (!is_urdf_type(extended) || extended == plain))
    joint.type = extended;
  else
    source.fault(extension->line, where,
                 std::string("<twinarm type=\"...\"> is '") + name + "', must be one of " +
                     joint_types_beyond_urdf(),
                 "give other types as <joint type=\"...\">", "urdf.joint-type");
}

// One warning for each kind of value that has no effect on this joint type.
void warn_without_effect(const XmlElement* element, const char* what, const std::string& where,
                         const JointDescription& joint, UrdfSource& source) {
  if (!element) return;
  source.warn_once(what, element->line, where,
                   std::string(what) + " has no effect on a " + to_string(joint.type) + " joint",
                   "remove it, or change the joint type", "urdf.no-effect");
}

void read_limits(const XmlElement& element, const std::string& where, JointDescription& joint,
                 UrdfSource& source) {
  const XmlElement* limit = element.child("limit");
  const bool has_range = limit && (limit->find("lower") || limit->find("upper"));
  if (limit) {
    joint.effort = source.bound(*limit, "effort", where, 0.0).value_or(0.0);
    joint.velocity = source.bound(*limit, "velocity", where, 0.0).value_or(0.0);
  }
  const bool must = joint.type == Type::revolute || joint.type == Type::prismatic;
  if (must && !limit) {
    source.fault(element.line, where,
                 std::string("a ") + to_string(joint.type) + " joint needs limits",
                 joint.type == Type::revolute
                     ? "give <limit lower upper effort velocity/>, or make the joint continuous"
                     : "give <limit lower upper effort velocity/> in metres",
                 "urdf.limits-missing");
    return;
  }
  if (must && !has_range)
    source.warn(limit->line, where, "its <limit> has neither lower nor upper",
                "give both: the default is 0, and the joint cannot move with limits",
                "urdf.no-limits");
  if (must && !(limit->find("effort") && limit->find("velocity")))
    source.warn_once(
        "limit without effort", limit->line, where, "its <limit> has no effort or velocity",
        "they have no effect here, but other programs reject the file", "urdf.no-effort");
  if (must || (joint.type == Type::screw && has_range)) {
    const auto lower = source.bound(*limit, "lower", where, 0.0);
    const auto upper = source.bound(*limit, "upper", where, 0.0);
    if (!lower || !upper) return;
    joint.lower = *lower;
    joint.upper = *upper;
    if (joint.type == Type::screw && !(joint.lower < joint.upper))  // it would be unlimited
      source.fault(limit->line, where,
                   "its lower limit " + number_text(joint.lower) +
                       " is not below its upper limit " + number_text(joint.upper),
                   "exchange them, or remove both", "robot.limits");
  } else if (has_range) {
    warn_without_effect(limit, "the range in <limit>", where, joint, source);
  }
}

// An axis of unit length or zero is returned unchanged.
Vector3 unit_axis(const Vector3& axis) {
  const double length = axis.stableNorm();
  return length < 1e-9 || std::abs(length - 1) < 1e-15 ? axis : Vector3(axis / length);
}

void read_axis(const XmlElement& element, const std::string& where, JointDescription& joint,
               UrdfSource& source) {
  const XmlElement* axis = element.child("axis");
  if (!joint.has_axis()) return warn_without_effect(axis, "<axis>", where, joint, source);
  if (!axis) return;  // default: x
  const Vector3 given = source.vector3(*axis, "xyz", where).value_or(Vector3::UnitX());
  joint.axis = unit_axis(given);
  const double length = given.stableNorm();
  if (length >= 1e-9 && std::abs(length - 1) > 1e-3)
    source.warn_once("length of axis", axis->line, where,
                     "its axis has length " + number_text(length),
                     "only the direction is used; give a unit vector", "urdf.axis-length");
}

void read_dynamics(const XmlElement& element, const std::string& where, JointDescription& joint,
                   UrdfSource& source) {
  if (const XmlElement* dynamics = element.child("dynamics")) {
    joint.damping = source.number(*dynamics, "damping", where, 0.0).value_or(0.0);
    joint.friction = source.number(*dynamics, "friction", where, 0.0).value_or(0.0);
    if (joint.type == Type::fixed && (joint.damping != 0 || joint.friction != 0))
      warn_without_effect(dynamics, "<dynamics>", where, joint, source);
  }
  joint.coulomb_plus = joint.coulomb_minus = joint.friction;
  const XmlElement* extension = element.child("twinarm");
  const auto take = [&](const char* attribute, double& value) {
    if (extension) value = source.number(*extension, attribute, where, value).value_or(value);
  };
  take("armature", joint.armature);
  take("coulomb_plus", joint.coulomb_plus);
  take("coulomb_minus", joint.coulomb_minus);
  const bool has_pitch = extension && extension->find("pitch");
  if (joint.type == Type::screw && extension && !has_pitch)
    source.fault(extension->line, where, "a screw joint must have a pitch",
                 "give <twinarm type=\"screw\" pitch=\"...\"/> in metres per revolution",
                 "urdf.pitch-missing");
  else if (joint.type == Type::screw)
    take("pitch", joint.pitch);
  else if (has_pitch)
    warn_without_effect(extension, "the pitch", where, joint, source);
}

void read_mimic(const XmlElement& element, const std::string& where, JointDescription& joint,
                UrdfSource& source) {
  const XmlElement* mimic = element.child("mimic");
  if (!mimic) return;
  JointDescription::Mimic m;
  m.joint = source.text(*mimic, "joint", where);
  m.multiplier = source.number(*mimic, "multiplier", where, 1.0).value_or(1.0);
  m.offset = source.number(*mimic, "offset", where, 0.0).value_or(0.0);
  if (!m.joint.empty()) joint.mimic = m;  // a missing name is already reported
}

}  // namespace

JointDescription read_joint(const XmlElement& element, UrdfSource& source) {
  JointDescription joint;
  joint.line = element.line;
  if (const char* name = element.value("name")) joint.name = name;
  const std::string where = "joint '" + joint.name + "'";
  for (const char* name : {"axis", "limit", "dynamics", "parent", "child", "mimic", "twinarm"})
    source.at_most_one(element, name, where);
  read_type(element, where, joint, source);
  joint.origin = source.origin(element, where);

  const auto line_of = [&](const char* name) {
    const XmlElement* e = element.child(name);
    return e ? e->line : 0;
  };
  joint.lines = {line_of("parent"),   line_of("child"),   line_of("axis"), line_of("limit"),
                 line_of("dynamics"), line_of("twinarm"), line_of("mimic")};
  const auto link_of = [&](const char* role) {  // missing ones: check_robot()
    const XmlElement* e = element.child(role);
    const char* link = e ? e->value("link") : nullptr;
    return std::string(link ? link : "");
  };
  joint.parent = link_of("parent");
  joint.child = link_of("child");
  read_axis(element, where, joint, source);
  read_limits(element, where, joint, source);
  read_dynamics(element, where, joint, source);
  read_mimic(element, where, joint, source);
  return joint;
}

}  // namespace twinarm
