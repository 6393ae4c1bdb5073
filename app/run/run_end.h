// How a run ends that stops by itself.
#pragma once

#include "app/run/run.h"

namespace twinarm {

double weight_of(const Model<double>& model);  // [N]
// RunPlan::energy_bound where none is given [J].
double default_energy_bound(const Model<double>& model, const State<double>& start);

// After a bad step from t, `last` the last good state: what is bad first, and which joint is
// fastest.
PostMortem examine_end(const StepReport& report, const Simulation& simulation,
                       const State<double>& last, double t, long step);

}  // namespace twinarm
