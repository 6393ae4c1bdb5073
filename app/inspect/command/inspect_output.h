// What `twinarm inspect` prints: one JSON object, or pages for people.
#pragma once

#include <string>
#include <vector>

#include "app/inspect/balance.h"
#include "app/inspect/checks.h"
#include "app/inspect/inspection.h"
#include "app/simulate/ledger.h"

namespace twinarm {

struct InspectView {
  std::vector<int> passes{1, 2, 3};
  std::vector<std::size_t> bodies;               // in the order of the model
  Viewpoint from;                                // of wrenches
  std::string axes = "world", about = "origin";  // as they were asked for
  std::vector<std::string> forces;               // sources to be read out; none: all
  bool forces_alone = false;                     // pages for people tell of nothing else
  std::string title;
  std::vector<LedgerRow> ledger;  // of a recording, up to its instant [J]
  std::vector<std::string> warnings;
};

// Those that the view asks for.
std::vector<NamedForce> forces_in_view(const Inspection& in, const InspectView& view);

std::string inspect_json(const Inspection& in, const InspectView& view,
                         const std::vector<Check>& checks);
std::string inspect_text(const Inspection& in, const InspectView& view,
                         const std::vector<Check>& checks);

}  // namespace twinarm
