// The numbers of a run at one time: what `simulate` prints, a recording keeps in each frame, and
// pages plot. A new one is a column here.
#pragma once

#include <string>
#include <vector>

#include "app/robot/robot_input.h"
#include "solver/dynamics/kinematics.h"

namespace twinarm {

struct RunColumn {
  std::string name, unit;  // "q/arm1" [rad], "links/hand/x" [m], "kinetic_energy" [J]
  std::string kind, of;    // "coordinate" of "arm1"; as in app/web/src/protocol/run.ts

  std::string with_unit() const { return name + "[" + unit + "]"; }
};

// Coordinates, velocities, positions of the links' origins; kinetic and potential energy last.
std::vector<RunColumn> run_columns(const RobotInput& input);
// In their order; k belongs to x.
std::vector<double> run_values(const RobotInput& input, const State<double>& x,
                               const Kinematics& k);

}  // namespace twinarm
