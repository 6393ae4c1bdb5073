// Energy of a mechanism at a state, for those who have no workspace at hand (world_kinematics.h):
// allocates.
#pragma once

#include "solver/model/model.h"

namespace twinarm {

double kinetic_energy(const Model<double>& model, const State<double>& x);  // with rotors [J]
// In the field of gravity, 0 at the world's origin [J].
double potential_energy(const Model<double>& model, const State<double>& x);

}  // namespace twinarm
