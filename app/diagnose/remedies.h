// What would have held, as changes that a button applies.
//
// From the limits of linear theory about the start (app/diagnose/post_mortem.h) and the run's last
// good state: a shorter step, a softer gain, an implicit treatment, the integrator that goes with
// it. Half of a limit in w h is offered, as the post-mortem's words do.
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

// Best first; each makes a scene that builds. Empty where nothing in the scene is to blame that is
// known of. `plan` is that of the run that stopped; `dead` may lack what explain() adds.
std::vector<SuggestedFix> remedies_of(const SimulatePlan& plan, const PostMortem& dead);

// The list `remedies` of docs/reference/lab_protocol.md.
void write_remedies(const std::vector<SuggestedFix>& remedies, JsonWriter& json);

}  // namespace twinarm
