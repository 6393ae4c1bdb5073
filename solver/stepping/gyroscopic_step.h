// How free bodies turn in a step of fixed size (constrained_step.h).
//
// About its centre of mass a free body turns by I w' + w x I w = n. With the moment w x I w of its
// start a step of first order adds h^2 |w x I w|^2 / 2 (in the norm of I^-1) to the energy: of a
// body that spins fast the nutation, of rate W, grows by h^2 W^2 / 2 in each step, without bound.
// With the moment of the mean velocity,
//   I (w' - w) + h m x I m = h n,      m = (w + w') / 2,
// no energy comes of it, and |I w| stays where n = 0: it turns I w, and does no more. w' is the
// velocity without impulses. Newton's method finds it; what the moment differs by enters the step
// as a couple, so that contacts and the step's last ABA have it.
//
// For bodies that are a tree of their own, without implicit terms of couplings.
#pragma once

#include <vector>

#include "solver/integration/integration_state.h"

namespace twinarm {

class GyroscopicCouples {
 public:
  explicit GyroscopicCouples(const Model<double>& model) : couple_(model.parent.size()) {}
  // After the acceleration without constraints: adds the couples to m.forces, and accelerates anew.
  void apply(IntegrationState& m, double h);
  // On the body, in body axes; in m.forces.f_ext.
  const Vec3<double>& of(std::size_t body) const { return couple_[body]; }

 private:
  std::vector<Vec3<double>> couple_;
};

}  // namespace twinarm
