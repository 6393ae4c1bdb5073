// The state file: where a robot is, how it moves, what acts on it (docs/command_line.md).
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "app/data/value.h"
#include "app/robot/coordinates.h"
#include "collision/import/robot/robot_description.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// A force at a point and a torque about that point, on a link.
struct Wrench {
  std::size_t body = 0;
  bool in_link_axes = false;  // else in world axes and coordinates
  Vector3 point = Vector3::Zero(), force = Vector3::Zero(), torque = Vector3::Zero();
};

struct GivenState {
  State<double> x;            // followers placed by their leaders
  Eigen::VectorXd tau, qdd;   // by rows of the mass matrix; of qdd the base's come first
  std::vector<bool> has_tau;  // by Coordinates::all(): whether the file names one
  std::vector<Wrench> wrenches;
  std::vector<std::string> warnings;
};

// Everything at rest at its identity.
GivenState default_state(const Model<double>& model, const Coordinates& coordinates);

// Adds all faults of the file to the list; what it returns is of use only if there are none. What
// the file leaves out is as in `start`.
GivenState read_state(const Value& json, const std::filesystem::path& file,
                      const RobotDescription& robot, const Model<double>& model,
                      const Coordinates& coordinates, const GivenState& start, FaultList& faults);

}  // namespace twinarm
