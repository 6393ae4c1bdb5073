// What `twinarm inspect` prints: one JSON object, or pages for people.
#pragma once

#include <string>
#include <vector>

#include "app/inspect/balance.h"
#include "app/inspect/checks.h"
#include "app/inspect/inspection.h"

namespace twinarm {

struct InspectView {
  std::vector<int> passes{1, 2, 3};
  std::vector<std::size_t> bodies;  // in the order of the model
  BalanceAxes axes = BalanceAxes::world;
  std::string title;
  std::vector<std::string> warnings;
};

std::string inspect_json(const Inspection& in, const InspectView& view,
                         const std::vector<Check>& checks);
std::string inspect_text(const Inspection& in, const InspectView& view,
                         const std::vector<Check>& checks);

}  // namespace twinarm
