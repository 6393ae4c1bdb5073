// The page of an inspected state: `inspect --json` with the robot beside it (docs/replay_page.md).
#pragma once

#include <string>
#include <vector>

#include "app/run/simulate_input.h"

namespace twinarm {

struct InspectedWords {
  std::string title, state;          // what is looked at, and in which state
  std::vector<std::string> command;  // as it was typed
};

// `inspection`: what inspect_json() says. Throws InputError where the program was built without its
// pages.
std::string inspect_page(const SimulateInput& input, const State<double>& x,
                         const std::string& inspection, const InspectedWords& words);

}  // namespace twinarm
