// Checks of a robot, independent of its file format.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "collision/import/robot/robot_description.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// Names of joint types in files.
const char* to_string(JointDescription::Type type);
bool joint_type_from(const std::string& text, JointDescription::Type& type);
std::string supported_joints();         // all of them, as a fix
std::string joint_types_beyond_urdf();  // "screw, ..."
// Types of URDF itself; and the URDF type written for other programs.
bool is_urdf_type(JointDescription::Type type);
JointDescription::Type urdf_type_of(JointDescription::Type type, bool limited);

struct RobotCheck {
  std::filesystem::path file;
  std::vector<Diagnostic> faults;  // errors; empty for a valid robot
  std::vector<Diagnostic> warnings;

  void fault(int line, std::string where, std::string problem, std::string fix,
             std::string_view code) {
    add_diagnostic(
        faults, {file.string(), line, std::move(where), std::move(problem), std::move(fix), code});
  }
  void warn(int line, std::string where, std::string problem, std::string fix,
            std::string_view code) {
    add_diagnostic(warnings, {file.string(), line, std::move(where), std::move(problem),
                              std::move(fix), code});
  }
};

// Names, the tree, inertias, axes, limits, damping, mimic joints. A physically impossible inertia
// is a warning, or an error if `strict`.
RobotCheck check_robot(const RobotDescription& robot, bool strict = false);

// Throws InputError with all errors in the order of their lines, if there are any.
void throw_in_line_order(std::vector<Diagnostic> faults);

// The link that is not a child of any joint; empty if there is not exactly one.
std::string find_root(const RobotDescription& robot);

// Indices into robot.joints, each joint after the joint of its parent link, else in the order of
// the file. The robot must have passed the check.
std::vector<std::size_t> joints_from_root(const RobotDescription& robot);

// Shared by robot_check.cpp and tree_checks.cpp.
struct ValidationContext : RobotCheck {
  const RobotDescription& robot;
};

inline std::string of(const LinkDescription& link) {
  return "link '" + link.name + "'";
}
inline std::string of(const JointDescription& joint) {
  return "joint '" + joint.name + "'";
}
// Line of the element if known, else of its link or joint.
inline int line_of(int element, int owner) {
  return element > 0 ? element : owner;
}

void check_mimics(ValidationContext& context);
void check_tree(ValidationContext& context);

}  // namespace twinarm
