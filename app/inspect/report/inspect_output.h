// What `twinarm inspect` prints: one JSON object, or pages for people.
#pragma once

#include <string>
#include <vector>

#include "app/accounting/energy_balance.h"
#include "app/data/json_writer.h"
#include "app/inspect/cross_checks.h"
#include "app/inspect/displayed_quantities.h"
#include "app/inspect/force_balance.h"
#include "app/inspect/inspection.h"

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

// Of a scene: what is inspected is what the step did.
Check step_check(const Inspection& in, const std::vector<double>& qdd_of_step);
// After a run that broke: where the passes break.
void warn_of_bad_numbers(const Inspection& in, std::vector<std::string>& warnings);

// Keys of the object that is open: what `inspect --json` prints.
void write_inspection(JsonWriter& json, const Inspection& in, const InspectView& view,
                      const std::vector<Check>& checks);
// The list at its key "passes", in the order in which aba() goes.
void write_passes(JsonWriter& json, const Inspection& in, const std::vector<int>& passes,
                  const std::vector<std::size_t>& bodies);
void write_quantities(JsonWriter& json, const std::vector<Shown>& quantities);
std::string inspect_json(const Inspection& in, const InspectView& view,
                         const std::vector<Check>& checks);
std::string inspect_text(const Inspection& in, const InspectView& view,
                         const std::vector<Check>& checks);

}  // namespace twinarm
