// Gyroscopic moment of free bodies in a step of fixed size (constrained_step.h).
//
// Euler's equation about the centre of mass: I dw/dt + w x I w = n. With w x I w at the start, a
// first-order step adds h^2 |w x I w|^2 / 2 (norm of I^-1) to the energy: nutation of rate W grows
// by h^2 W^2 / 2 per step, without bound. With the mean velocity,
//   I (w' - w) + h m x I m = h n,      m = (w + w') / 2,
// the moment does no work, and |I w| is constant for n = 0. w' (without constraint impulses) is
// computed by Newton's method; the difference of the moments is added to f_ext as a couple.
//
// Applied to bodies that are a tree of their own, without implicit terms of couplings.
#pragma once

#include <vector>

#include "solver/integration/integration_state.h"

namespace twinarm {

class GyroscopicCouples {
 public:
  explicit GyroscopicCouples(const Model<double>& model) : couple_(model.parent.size()) {}
  // After the acceleration without constraints: adds the couples to m.forces and repeats ABA.
  void apply(IntegrationState& m, double h);
  // Couple on the body, body axes, contained in m.forces.f_ext.
  const Vec3<double>& of(std::size_t body) const { return couple_[body]; }

 private:
  std::vector<Vec3<double>> couple_;
};

}  // namespace twinarm
