// A recorded instant, opened again: for inspection.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "app/accounting/energy_balance.h"
#include "app/record/unpack.h"
#include "app/run/simulate_input.h"
#include "solver/support/state_archive.h"

namespace twinarm {

// Whether the file begins as a recording, is named like one, or there is only its .part.
bool is_recording(const std::filesystem::path& file);

// Adds a fault where options were given that change a model or its state: a recording has both.
void check_recorded(const RobotOptions& given, FaultList& faults);

struct RecordedInstant {
  SimulatePlan prepared;  // its state is that of the instant; so are the points of wrenches
  Memory memory;          // for Simulation::visit_memory of a simulation that is built alike
  double t = 0;           // of the frame [s]
  std::vector<LedgerRow> ledger;  // up to it [J]
  // The files that it was made from: meshes are read when contacts are set up, which is later.
  std::shared_ptr<const UnpackedRun> files;
};

// The last frame at or before `at`; left out: the last of all. Prepared for semi-implicit steps;
// `prepared.run.integrator` is that of the run. Throws InputError.
RecordedInstant open_instant(const std::filesystem::path& file, std::optional<double> at);

}  // namespace twinarm
