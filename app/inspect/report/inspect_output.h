// What `twinarm inspect` prints: one JSON object, or pages for people.
#pragma once

#include <string>
#include <vector>

#include "app/accounting/energy_balance.h"
#include "app/data/json_writer.h"
#include "app/data/tables.h"
#include "app/inspect/cross_checks.h"
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
  std::vector<EnergyRow> ledger;  // of a recording, up to its instant [J]
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
void write_quantities(JsonWriter& json, const std::vector<DisplayedQuantity>& quantities);
std::string inspect_json(const Inspection& in, const InspectView& view,
                         const std::vector<Check>& checks);
std::string inspect_text(const Inspection& in, const InspectView& view,
                         const std::vector<Check>& checks);

// "world axes, about each link's origin".
std::string viewpoint_in_words(const InspectView& view);

// The wrenches on each body, and the forces that have names of their own.
void write_balances(const Inspection& in, const InspectView& view, Sheet& sheet);
void write_named_forces(const Inspection& in, const InspectView& view, Sheet& sheet);

// A number, or several in brackets.
std::string name_of_number(const Eigen::VectorXd& v);
// Of a unit "angular; linear": that of the body's joint. Empty where it has several velocities.
std::string unit_at_joint(const Inspection& in, std::size_t body, std::string_view unit);

// Which joint carries the body, and where it stands.
void write_body_head(const Inspection& in, std::size_t body, Sheet& sheet);
// The quantities of a pass (1 to 3) by the equations of table 7.1, with the numbers put in, in the
// order in which they are found. `D_error`: of the cross-check of D.
void write_pass(const Inspection& in, int pass, std::size_t body, double D_error, Sheet& sheet);

}  // namespace twinarm
