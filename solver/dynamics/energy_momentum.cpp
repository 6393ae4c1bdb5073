#include "solver/dynamics/energy_momentum.h"

#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/kinematics.h"
#include "solver/dynamics/world_kinematics.h"

namespace twinarm {

std::vector<char> bodies_with_dofs(const Model<double>& model) {
  std::vector<char> moved(model.parent.size(), 0);
  for (std::size_t i = 1; i < moved.size(); ++i)
    moved[i] = model.dofs(i) > 0 || moved[static_cast<std::size_t>(model.parent[i])] ? 1 : 0;
  return moved;
}

EnergyMomentum energy_and_momentum_of(const Model<double>& model, const std::vector<char>& of,
                                      const State<double>& x, Workspace<double>& w) {
  kinematics(model, x, w);
  Force<double> sum;
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    if (of[i]) sum += transpose_times(w.X0[i], model.I[i] * w.v[i]);
  return {kinetic_energy(model, x, w) + potential_energy(model, w), to_eigen(sum.f),
          to_eigen(sum.n)};
}

double kinetic_energy(const Model<double>& model, const State<double>& x) {
  BodyKinematics<double> w(model);
  kinematics(model, x, w);
  return kinetic_energy(model, x, w);
}

double potential_energy(const Model<double>& model, const State<double>& x) {
  BodyKinematics<double> w(model);
  kinematics(model, x, w);
  return potential_energy(model, w);
}

}  // namespace twinarm
