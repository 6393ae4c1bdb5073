// What robot_check.cpp and tree_checks.cpp share, which alone include it.
#pragma once

#include <string>
#include <utility>

#include "collision/import/robot/robot_check.h"

namespace twinarm {

struct RuleBook {
  const RobotDescription& robot;
  RobotCheck found;

  void fault(int line, std::string where, std::string rule, std::string remedy,
             std::string_view code) {
    add_fault(found.faults, {robot.file.string(), line, std::move(where), std::move(rule),
                             std::move(remedy), code});
  }
  void warn(int line, std::string where, std::string rule, std::string remedy) {
    add_fault(found.warnings,
              {robot.file.string(), line, std::move(where), std::move(rule), std::move(remedy)});
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

void check_mimics(RuleBook& book);
void check_tree(RuleBook& book);

}  // namespace twinarm
