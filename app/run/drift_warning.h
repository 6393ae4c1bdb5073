// A warning for floating-base robots under semi-implicit Euler, whose steps in joint coordinates do
// not conserve the momentum of a tree with joints: the drift is of first order in the step.
#pragma once

#include <string>

#include "app/run/simulate_options.h"
#include "solver/stepping/simulation.h"

namespace twinarm {

// Empty where nothing drifts: no floating base with joints; an integrator of higher order, or
// events located in time; contacts or limits under gravity, which set the momentum themselves.
std::string drift_warning(const Simulation& simulation, const RunPlan& plan);

}  // namespace twinarm
