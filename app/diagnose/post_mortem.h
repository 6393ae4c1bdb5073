// Cause of divergence of a run: first non-finite quantity, violated stability limits, the row of
// the energy balance that grew, and suggested fixes. The last steps are recomputed from a
// checkpoint and recorded, at no cost to other runs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/data/json_writer.h"
#include "app/record/recording.h"
#include "app/run/run.h"
#include "app/run/simulate_input.h"

namespace twinarm {

// Completes result.post_mortem and writes the last steps to `file`. That it cannot be written is
// reported in the words.
void explain(const SimulatePlan& prepared, RecordingHeader header,
             const std::filesystem::path& file, SimulateResult& result);

// Without a recording. `run` is at its stop; `before`: its energy balance some time earlier.
void explain_at_once(const SimulatePlan& prepared, const SteppedRun& run,
                     const std::vector<EnergyRow>& before, SimulateResult& result);

// Text of an alarm: row, time, likely cause and fix.
std::string alarm_words(const Alarm& alarm, const SimulatePlan& prepared);

// Stability limits of couplings and joint dampers by linear theory about the initial state
// (coupling/analysis/prediction.h), largest violation first.
std::vector<StabilityViolation> find_violations(const SimulatePlan& prepared);

// Scene changes that would have kept the run stable: shorter step, softer gain, implicit
// discretization with its integrator. Suggested values are at half the limit of omega h.
struct SuggestedFix {
  std::string words;                 // "step 0.5 ms"
  std::vector<std::string> changes;  // PATH=VALUE, all together
};

// Best first; each gives a valid scene. Empty where no cause was found. `plan` is that of the
// diverged run; `post_mortem` may lack what explain() adds.
std::vector<SuggestedFix> fixes_of(const SimulatePlan& plan, const PostMortem& post_mortem);

// The list `remedies` of docs/reference/lab_protocol.md.
void write_remedies(const std::vector<SuggestedFix>& remedies, JsonWriter& json);

}  // namespace twinarm
