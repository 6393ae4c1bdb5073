// Scene changes that would have kept a diverged run stable.
//
// By linear theory about the initial state (app/diagnose/post_mortem.h): shorter step, softer gain,
// implicit discretization with its integrator. Suggested values are at half the limit of omega h.
#pragma once

#include <string>
#include <vector>

#include "app/data/json_writer.h"
#include "app/run/run.h"

namespace twinarm {

struct SuggestedFix {
  std::string words;                 // "a step of 0.5 ms"
  std::vector<std::string> changes;  // PATH=VALUE, all together
};

// Best first; each gives a valid scene. Empty where no cause was found. `plan` is that of the
// diverged run; `post_mortem` may lack what explain() adds.
std::vector<SuggestedFix> remedies_of(const SimulatePlan& plan, const PostMortem& post_mortem);

// The list `remedies` of docs/reference/lab_protocol.md.
void write_remedies(const std::vector<SuggestedFix>& remedies, JsonWriter& json);

}  // namespace twinarm
