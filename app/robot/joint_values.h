// Coordinates and velocities of joints by name, as scenes and state files give them
// (docs/command_line.md, "The state file").
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/data/table_reader.h"
#include "collision/import/robot/robot_description.h"

namespace twinarm {

struct JointValues {
  std::vector<double> values;
  int line = 0;
};
using JointValueMap = std::map<std::string, JointValues>;

enum class JointRows { coordinates, velocities };

// Of each joint that is named: as many numbers as it has coordinates or velocities, quaternions of
// length 1. Faults for the others. `warnings`: where a quaternion was off by more than rounding.
JointValueMap read_joint_values(TableReader& joints, const RobotDescription& robot, JointRows rows,
                                std::vector<std::string>* warnings = nullptr);

// A quaternion in place: its length brought to 1, or a fault.
void normalise(TableReader& table, const std::string& key, std::span<double, 4> q,
               std::vector<std::string>* warnings);

}  // namespace twinarm
