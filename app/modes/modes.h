// `twinarm modes`: linearisation of a robot or scene about its state, with its constraints.
#pragma once

#include <string>
#include <vector>

#include "app/modes/linear_system.h"
#include "app/run/simulate_input.h"

namespace twinarm {

struct ModesOf {
  LoopedSystem looped;
  std::vector<Mode> modes;         // by all velocities of the model
  std::vector<NamedJoint> joints;  // of shapes: those of robots, then bodies with constraints
  std::vector<std::string> rows;   // names of dq, the rows of A
  std::vector<std::string> warnings;
};
// At the state of the input, its velocities projected on the constraints.
ModesOf find_modes(SimulateInput& input);

std::string modes_json(const SimulateInput& input, const ModesOf& found);
std::string modes_table(const SimulateInput& input, const ModesOf& found);

}  // namespace twinarm
