#include "app/robot/robot_table.h"

namespace twinarm {

JointUnits::JointUnits(const Coordinates& coordinates) {
  bool angles = false, lengths = false;
  for (const NamedJoint& joint : coordinates.all())
    for (const JointComponent& c : joint.components()) (c.is_angle ? angles : lengths) = true;
  const auto both = [&](const char* of_angle, const char* of_length) {
    if (!lengths) return std::string(of_angle);
    if (!angles) return std::string(of_length);
    return std::string(of_angle) + ", " + of_length;
  };
  q = both("rad", "m");
  qd = both("rad/s", "m/s");
  qdd = both("rad/s^2", "m/s^2");
  tau = both("N m", "N");
}

std::string component_name(const Coordinates& coordinates, const NamedJoint& joint,
                           const JointComponent& component) {
  const bool is_base = coordinates.floating() && &joint == &coordinates.base();
  const std::string name = is_base ? "base" : joint.name;
  return *component.label ? name + "/" + component.label : name;
}

std::vector<std::string> row_names(const Coordinates& coordinates) {
  std::vector<std::string> names;
  for (const NamedJoint& joint : coordinates.all())
    for (const JointComponent& c : joint.components())
      if (c.v >= 0) names.push_back(component_name(coordinates, joint, c));
  return names;
}

}  // namespace twinarm
