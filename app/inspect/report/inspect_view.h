// What `twinarm inspect` is asked to show, out of its options.
#pragma once

#include "app/inspect/report/inspect_options.h"
#include "app/inspect/report/inspect_output.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// --pass; all if none is given.
void read_passes(const InspectOptions& options, InspectView& view, FaultList& faults);
// --body, --axes, --about: names of bodies.
void read_bodies(const InspectOptions& options, const Model<double>& model, InspectView& view,
                 FaultList& faults);
// --force: the whole name of a force, or what stands after its first slash; of a contact with
// several points without their numbers all of them.
void read_forces(const InspectOptions& options, const std::vector<Actor>& actors, InspectView& view,
                 FaultList& faults);

}  // namespace twinarm
