// The rules that every robot must keep, whatever file it was read from.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "collision/import/robot/robot_description.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// The names of the joint types as files spell them.
const char* to_string(JointDescription::Type type);
bool joint_type_from(const std::string& text, JointDescription::Type& type);
std::string supported_joints();         // all of them, as a remedy
std::string joint_types_beyond_urdf();  // "screw, ..."
// Those that URDF itself has; and the one by which other programs shall know the type.
bool is_urdf_type(JointDescription::Type type);
JointDescription::Type urdf_type_of(JointDescription::Type type, bool limited);

struct RobotCheck {
  std::vector<Diagnostic> faults;    // empty for a good robot
  std::vector<Diagnostic> warnings;  // what is suspicious, but can be computed with
};

// Names, the tree, inertias, axes, limits, damping, mimics. An inertia that no rigid body has is a
// warning, or a fault where `strict`.
RobotCheck check_robot(const RobotDescription& robot, bool strict = false);

// Throws InputError with all faults in the order of their lines; returns if there is none.
void throw_in_line_order(std::vector<Diagnostic> faults);

// The link that is no joint's child; empty where there is not exactly one.
std::string find_root(const RobotDescription& robot);

// Indices into robot.joints, each joint after the joint that carries its parent link; among those
// that are ready at the same time, in the order of the file. The robot must have passed the check.
std::vector<std::size_t> joints_from_root(const RobotDescription& robot);

// What robot_check.cpp and tree_checks.cpp share, which alone include it.
struct ValidationContext {
  const RobotDescription& robot;
  RobotCheck found;

  void fault(int line, std::string where, std::string problem, std::string fix,
             std::string_view code) {
    add_diagnostic(found.faults, {robot.file.string(), line, std::move(where), std::move(problem),
                                  std::move(fix), code});
  }
  void warn(int line, std::string where, std::string problem, std::string fix,
            std::string_view code) {
    add_diagnostic(found.warnings, {robot.file.string(), line, std::move(where), std::move(problem),
                                    std::move(fix), code});
  }
};

inline std::string of(const LinkDescription& link) {
  return "link '" + link.name + "'";
}
inline std::string of(const JointDescription& joint) {
  return "joint '" + joint.name + "'";
}
// The line of the element itself where it is known, of the link or joint where it is not.
inline int line_of(int element, int owner) {
  return element > 0 ? element : owner;
}

void check_mimics(ValidationContext& book);
void check_tree(ValidationContext& book);

}  // namespace twinarm
