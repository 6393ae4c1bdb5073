// Derivatives of forward dynamics by Dual<8>: eight directions at a time through aba().
#pragma once

#include <Eigen/Core>

#include "solver/dynamics/dynamics.h"

namespace twinarm {

// nv x nv each. d/dq is along the joints' groups: column k is the rate of qdd when q moves to
// q exp(s e_k), s = 0 (for vector joints the usual partial derivative). External wrenches stay
// fixed to their bodies.
struct ForwardDynamicsDerivatives {
  Eigen::MatrixXd dq, dqd, dtau;
};
// Allocates; forces.armature and forces.impedance enter as constants.
ForwardDynamicsDerivatives forward_dynamics_derivatives(const Model<double>& model,
                                                        const State<double>& x,
                                                        const Forces<double>& forces);

}  // namespace twinarm
