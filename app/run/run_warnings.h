// What a run warns of besides its result; each is empty where there is nothing to warn of.
#pragma once

#include <string>

#include "app/run/simulate_options.h"
#include "app/scene/forces/add_contacts.h"
#include "solver/stepping/simulation.h"

namespace twinarm {

// Floating-base robots under semi-implicit Euler, whose steps in joint coordinates do not conserve
// the momentum of a tree with joints: the drift is of first order in the step. Not with events
// located in time, nor with contacts or limits under gravity, which set the momentum themselves.
std::string drift_warning(const Simulation& simulation, const RunPlan& plan);

// Bodies that penetrate one another deeply at the start.
std::string deep_start_warning(const SceneContacts& contacts, ContactMode mode);

// Steps whose equation was not solved, and steps in which not all events were located.
std::string unsolved_warning(long unsolved, long steps);
std::string unlocated_warning(long unlocated, long steps);

}  // namespace twinarm
