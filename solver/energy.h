// Energy and momentum of a mechanism.
#pragma once

#include "solver/model.h"

namespace twinarm {

double kinetic_energy(const Model<double>& model, const State<double>& x);  // [J]
// Of the moving bodies under gravity alone, 0 at the world's origin [J].
double potential_energy(const Model<double>& model, const State<double>& x);

}  // namespace twinarm
