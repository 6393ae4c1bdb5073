// Names and units of joint values in tables and CSV.
#pragma once

#include <string>
#include <vector>

#include "app/robot/coordinates.h"

namespace twinarm {

// Of a column that holds values of all joints: "rad", "m", or "rad, m" where there are both.
struct JointUnits {
  std::string q, qd, qdd, tau;
  explicit JointUnits(const Coordinates& coordinates);
};

// Of the rows of the mass matrix: "j1", "ball/x", "base/vx".
std::vector<std::string> row_names(const Coordinates& coordinates);

// "base" for the joint that carries a floating root, else the joint's name; and which number of it.
std::string component_name(const Coordinates& coordinates, const NamedJoint& joint,
                           const JointComponent& component);

}  // namespace twinarm
