#include <fmt/format.h>

#include "app/commands.h"
#include "app/dynamics/dynamics_output.h"

namespace twinarm {

int run_dynamics(const DynamicsOptions& options) {
  const RobotInput input = read_robot_input(options.robot);
  const Dynamics dynamics = compute_dynamics(input);
  fmt::print("{}\n",
             options.json ? dynamics_json(input, dynamics) : dynamics_table(input, dynamics));
  return 0;
}

}  // namespace twinarm
