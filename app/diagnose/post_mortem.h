// Why a run stopped by itself, in plain words: the first bad quantity, the spring or damper behind
// it, the ledger's row that grew, and what would hold. Its last steps are computed again from a
// checkpoint, bit for bit, and recorded: a run that ends well pays nothing for them.
#pragma once

#include <filesystem>

#include "app/record/recording.h"
#include "app/run/run.h"
#include "app/run/simulate_input.h"

namespace twinarm {

constexpr long kLastSteps = 1000;

// Adds to result.post_mortem. The recording goes to `file`; where that cannot be written the words
// say so.
void explain(const SimulatePlan& prepared, RecordingHeader header,
             const std::filesystem::path& file, SimulateResult& result);

// The same without a recording, for a run that cannot be computed again from its checkpoint, or
// that is remembered elsewhere. `run` stands where it stopped; `before`: its ledger some time
// earlier.
void explain_at_once(const SimulatePlan& prepared, const RunView& run,
                     const std::vector<EnergyRow>& before, SimulateResult& result);

// What an alarm says: the row, when, and what would hold.
std::string alarm_words(const Alarm& alarm, const SimulatePlan& prepared);

// Springs and dampers that this integrator takes at the start of a step, against their limits of
// linear theory about the start (coupling/analysis/prediction.h); the worst first.
std::vector<StabilityViolation> find_suspects(const SimulatePlan& prepared);

}  // namespace twinarm
