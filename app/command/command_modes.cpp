// `twinarm modes`: small motions about a state, of a robot or of a scene whose parts are held.
#include <fmt/format.h>

#include "app/command/commands.h"
#include "app/modes/modes_input.h"

namespace twinarm {

int run_modes(const ModesOptions& options) {
  FaultList faults;
  SimulateOptions simulate;
  simulate.robot = options.robot;
  simulate.duration = 1;
  simulate.integrator = "semi-implicit";
  auto prepared = attempt(faults, [&] { return prepare_simulation(simulate); });
  faults.check();

  SimulateInput& input = prepared->input;
  if (input.scene && input.robot.coordinates.all().empty() && input.scene->constraints.empty())
    throw InputError({{input.scene->description.file.string(), 0, "scene",
                       "it has neither a robot with a joint nor a constraint, and modes are those "
                       "of what is held",
                       ""}});
  const ModesOf found = find_modes(input);
  fmt::print("{}\n", options.json ? modes_json(input, found) : modes_table(input, found));
  return 0;
}

}  // namespace twinarm
