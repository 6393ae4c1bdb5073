#include "solver/dynamics/energy.h"

#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/world_kinematics.h"

namespace twinarm {

double kinetic_energy(const Model<double>& model, const State<double>& x) {
  Workspace<double> w(model);
  kinematics(model, x, w);
  return kinetic_energy(model, x, w);
}

double potential_energy(const Model<double>& model, const State<double>& x) {
  Workspace<double> w(model);
  kinematics(model, x, w);
  return potential_energy(model, w);
}

}  // namespace twinarm
