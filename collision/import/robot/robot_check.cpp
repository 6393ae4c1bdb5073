// Checks of names and values (the tree and mimic joints: tree_checks.cpp).
#include "collision/import/robot/robot_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

#include "solver/linear_algebra/dense_algebra.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

using Type = JointDescription::Type;

constexpr std::array kUrdfTypes{Type::fixed,     Type::revolute, Type::continuous,
                                Type::prismatic, Type::floating, Type::planar};

// All joint types in files, URDF's first. Prescribed motion cannot be given in a file.
std::vector<Type> file_types() {
  std::vector<Type> types(kUrdfTypes.begin(), kUrdfTypes.end());
  for (const JointType joint : all_joint_types)
    if (const auto type = static_cast<Type>(joint); facts_of(joint).nv > 0 && !is_urdf_type(type))
      types.push_back(type);
  return types;
}
std::string names_of(std::span<const Type> types) {
  std::string text;
  for (const Type type : types) text += (text.empty() ? "" : ", ") + std::string(to_string(type));
  return text;
}

template <class Item>
void check_names(ValidationContext& context, const std::vector<Item>& items,
                 const std::string& kind) {
  std::map<std::string, int> first_line;
  for (const Item& item : items) {
    if (item.name.empty()) {
      context.fault(item.line, kind, "the name is missing", "give it a unique name",
                    "robot.name-missing");
      continue;
    }
    const auto [first, is_new] = first_line.emplace(item.name, item.line);
    if (!is_new)
      context.fault(
          item.line, of(item),
          "duplicate name, used by the " + kind + " in line " + std::to_string(first->second),
          "give each " + kind + " a unique name", "robot.name-taken");
  }
}

// Relative tolerance of A + B >= C: a thin plate has A + B = C, and files round to about six
// digits.
constexpr double kTriangleSlack = 1e-6;
// Relative rounding of a moment after a rotation of the axes.
constexpr double kRounding = 1e-12;

// Principal moments A <= B <= C of a body of positive density: A > 0 and A + B >= C.
void check_moments(ValidationContext& context, const LinkDescription& link, bool strict) {
  const Vector3 moments = symmetric_eigenvalues(link.inertia);  // ascending
  std::string problem;
  if (!(moments[0] > kRounding * moments.cwiseAbs().maxCoeff()))
    problem = "its inertia is not positive definite";
  else if (moments[0] + moments[1] < moments[2] * (1 - kTriangleSlack))
    problem = "its inertia violates the triangle inequality A + B >= C";
  else
    return;
  problem += ": principal moments " + short_number_text(moments[0]) + ", " +
             short_number_text(moments[1]) + ", " + short_number_text(moments[2]) + " kg m^2";
  const int line = line_of(link.inertia_line, link.line);
  if (strict)
    context.fault(line, of(link), problem,
                  "no rigid body of positive density has it; check units, signs and the order ixx "
                  "ixy ixz iyy iyz izz, about the centre of mass",
                  "robot.inertia-not-physical");
  else
    context.warn(line, of(link), problem,
                 "no rigid body of positive density has it; forward dynamics may still work, "
                 "MuJoCo and Drake reject it",
                 "robot.inertia");
}

void check_inertia(ValidationContext& context, const LinkDescription& link, bool strict) {
  if (!link.has_inertia) return;
  const int mass_line = line_of(link.mass_line, link.line);
  if (!std::isfinite(link.mass) || !link.com.allFinite() || !link.inertia.allFinite())
    return context.fault(mass_line, of(link), "its mass, centre of mass or inertia is not finite",
                         "give finite numbers in SI units", "robot.not-finite");
  if (link.mass < 0)
    context.fault(mass_line, of(link),
                  "its mass is " + number_text(link.mass) + " kg, must not be negative",
                  "give the mass in kg", "robot.negative");
  if (link.inertia.isZero(0)) {
    if (link.mass > 0)
      context.warn(
          line_of(link.inertia_line, link.line), of(link),
          "its inertia is zero: a point mass of " + number_text(link.mass) + " kg",
          "give its inertia; otherwise a joint whose axis passes through the point has none",
          "robot.inertia");
    return;  // without mass: a frame
  }
  if (link.mass == 0)
    context.warn(mass_line, of(link), "its mass is 0, but its inertia is not",
                 "give its mass; model a rotor with <twinarm armature=\"...\"/>", "robot.no-mass");
  check_moments(context, link, strict);
}

void check_values(ValidationContext& context, const JointDescription& joint) {
  const JointDescription::Lines& lines = joint.lines;
  if (joint.has_axis() && !(joint.axis.norm() >= 1e-9))
    context.fault(line_of(lines.axis, joint.line), of(joint), "its axis is zero",
                  "give a direction such as 0 0 1", "robot.axis-zero");
  if (joint.is_limited() && !(joint.lower <= joint.upper))
    context.fault(line_of(lines.limits, joint.line), of(joint),
                  "its lower limit " + number_text(joint.lower) + " is above its upper limit " +
                      number_text(joint.upper),
                  "exchange them, or make the joint continuous", "robot.limits");
  if (joint.type == JointDescription::Type::screw && joint.pitch == 0)
    context.warn(line_of(lines.extension, joint.line), of(joint), "its pitch is 0",
                 "it equals a revolute joint: make it continuous", "robot.pitch");
  const auto not_negative = [&](const char* name, double value, int line) {
    if (!(value >= 0) || std::isinf(value))
      context.fault(
          line_of(line, joint.line), of(joint),
          std::string("its ") + name + " is " + number_text(value) + ", must not be negative",
          "give 0 or more: a negative value would add energy", "robot.negative");
  };
  not_negative("damping", joint.damping, lines.dynamics);
  not_negative("friction", joint.friction, lines.dynamics);
  not_negative("armature", joint.armature, lines.extension);
  // Equal to `friction` by default: report only once.
  const double plus = joint.coulomb_plus, minus = joint.coulomb_minus;
  if (plus != joint.friction) not_negative("coulomb_plus", plus, lines.extension);
  if (minus != joint.friction) not_negative("coulomb_minus", minus, lines.extension);
}

}  // namespace

const char* to_string(Type type) {
  return type == Type::continuous ? "continuous"
         : type == Type::floating ? "floating"
                                  : name_of(JointDescription::joint_type(type));
}

bool joint_type_from(const std::string& text, Type& type) {
  for (const Type known : file_types())
    if (text == to_string(known)) {
      type = known;
      return true;
    }
  return false;
}

std::string supported_joints() {
  return "types: " + names_of(kUrdfTypes) + ", and beyond URDF " + joint_types_beyond_urdf();
}

std::string joint_types_beyond_urdf() {
  const std::vector<Type> types = file_types();
  return names_of(std::span(types).subspan(kUrdfTypes.size()));
}

bool is_urdf_type(Type type) {
  return std::find(kUrdfTypes.begin(), kUrdfTypes.end(), type) != kUrdfTypes.end();
}

Type urdf_type_of(Type type, bool limited) {
  if (is_urdf_type(type)) return type;
  if (facts_of(JointDescription::joint_type(type)).axis == AxisUse::none) return Type::floating;
  return limited ? Type::revolute : Type::continuous;
}

RobotCheck check_robot(const RobotDescription& robot, bool strict) {
  ValidationContext context{{robot.file, {}, {}}, robot};
  if (robot.links.empty())
    context.fault(0, "robot '" + robot.name + "'", "the robot has no link",
                  "give at least one link", "robot.empty");
  check_names(context, robot.links, "link");
  check_names(context, robot.joints, "joint");
  for (const LinkDescription& link : robot.links) check_inertia(context, link, strict);
  for (const JointDescription& joint : robot.joints) check_values(context, joint);
  check_mimics(context);
  check_tree(context);
  return context;
}

void throw_in_line_order(std::vector<Diagnostic> faults) {
  std::ranges::stable_sort(faults, {}, &Diagnostic::line);
  if (!faults.empty()) throw InputError(std::move(faults));
}

}  // namespace twinarm
