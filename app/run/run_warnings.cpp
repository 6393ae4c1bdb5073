// Warnings at the end of a run: errors of its steps that are larger than what was asked for.
#include <fmt/format.h>

#include "app/run/stepped_run.h"
#include "solver/stepping/event_driven_step.h"
#include "solver/support/number_text.h"

namespace twinarm {

void SteppedRun::warn_of_errors() {
  if (unsolved_ > 0)
    warn(sim_.has_constrained_steps()
             ? fmt::format("in {} of {} steps the impulses of contacts and limits miss their laws "
                           "by more than the accuracy, by {} m/s at most; give a larger budget, "
                           "or accept another accuracy (docs/reference/scene_file.md)",
                           unsolved_, result_.steps, short_number_text(result_.residual))
             : fmt::format("in {} of {} steps the implicit equation did not converge to rounding",
                           unsolved_, result_.steps));
  if (unlocated_ > 0)
    warn(fmt::format(
        "in {} of {} steps the event limit was reached ({} contact problems); the remainder of the "
        "step is first-order accurate; give --contact rigid, which does not locate events (a "
        "shorter --step may locate them all, at the limit in each step)",
        unlocated_, result_.steps, EventStep::kMaxLaws));
  if (const auto use = contacts_ ? contacts_->fcl_use() : CollisionWorld::FclUse();
      use.rejected > 0)
    warn(
        fmt::format("detection = \"own\" answered {} of {} queries of pairs, too deep for FCL or "
                    "inconsistent (docs/understand/narrow_phases.md)",
                    use.rejected, use.queries));
  warn(impact_normals_.warning());
}

}  // namespace twinarm
