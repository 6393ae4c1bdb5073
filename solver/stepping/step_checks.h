// Which integrators, sources of forces and sources of constraints go with one another: all throw
// std::invalid_argument where they do not.
#pragma once

#include <optional>
#include <vector>

#include "solver/forces/force_source.h"
#include "solver/impulses/constraint_source.h"
#include "solver/integration/integrator.h"

namespace twinarm {

// What a simulation is made of.
struct StepParts {
  Integrator integrator;
  bool constrained, located;  // steps under constraints; that locate their events
  const std::vector<ForceSource*>& forces;
  const std::vector<ConstraintSource*>& constraints;
};
void check_parts(const StepParts& parts);

}  // namespace twinarm
