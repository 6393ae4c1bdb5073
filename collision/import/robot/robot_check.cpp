// The rules that every robot must keep: names here, the others in robot_*_rules.cpp.
#include "collision/import/robot/robot_check.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "collision/import/robot/robot_validation.h"

namespace twinarm {
namespace {

using Type = JointDescription::Type;

// The one list of the joint types. A new one needs its name here, `true` if URDF has it.
struct TypeName {
  Type type;
  const char* name;
  bool in_urdf;
};
constexpr std::array<TypeName, 10> kTypes{{{Type::fixed, "fixed", true},
                                           {Type::revolute, "revolute", true},
                                           {Type::continuous, "continuous", true},
                                           {Type::prismatic, "prismatic", true},
                                           {Type::floating, "floating", true},
                                           {Type::planar, "planar", true},
                                           {Type::screw, "screw", false},
                                           {Type::cylindrical, "cylindrical", false},
                                           {Type::universal, "universal", false},
                                           {Type::spherical, "spherical", false}}};

template <class Item>
void unique_names(RuleBook& book, const std::vector<Item>& items, const std::string& kind) {
  std::map<std::string, int> first_line;
  for (const Item& item : items) {
    if (item.name.empty()) {
      book.fault(item.line, kind, "it has no name", "give it a name of its own",
                 "robot.name-missing");
      continue;
    }
    const auto [first, is_new] = first_line.emplace(item.name, item.line);
    if (!is_new)
      book.fault(
          item.line, of(item),
          "the name is taken already by the " + kind + " of line " + std::to_string(first->second),
          "give each " + kind + " a name of its own", "robot.name-taken");
  }
}

}  // namespace

const char* to_string(Type type) {
  for (const TypeName& entry : kTypes)
    if (entry.type == type) return entry.name;
  return "";
}

bool joint_type_from(const std::string& text, Type& type) {
  for (const TypeName& entry : kTypes)
    if (text == entry.name) {
      type = entry.type;
      return true;
    }
  return false;
}

bool is_urdf_type(Type type) {
  for (const TypeName& entry : kTypes)
    if (entry.type == type) return entry.in_urdf;
  return false;
}

Type urdf_type_of(Type type, bool limited) {
  if (is_urdf_type(type)) return type;
  if (type == Type::spherical) return Type::floating;
  return limited ? Type::revolute : Type::continuous;
}

RobotCheck check_robot(const RobotDescription& robot, bool strict) {
  RuleBook book{robot, {}};
  if (robot.links.empty())
    book.fault(0, "robot '" + robot.name + "'", "it has no link", "give at least one link",
               "robot.empty");
  unique_names(book, robot.links, "link");
  unique_names(book, robot.joints, "joint");
  check_values(book, strict);
  check_mimics(book);
  check_tree(book);
  return std::move(book.found);
}

void throw_in_line_order(std::vector<Fault> faults) {
  std::stable_sort(faults.begin(), faults.end(),
                   [](const Fault& a, const Fault& b) { return a.line < b.line; });
  if (!faults.empty()) throw InputError(std::move(faults));
}

}  // namespace twinarm
