// Derivatives of forward dynamics by automatic differentiation of aba(), Dual<8>.
#pragma once

#include <Eigen/Core>

#include "solver/dynamics/dynamics.h"

namespace twinarm {

// nv x nv each. Column k of dq is d qdd / ds for q exp(s e_k) at s = 0 (for vector joints the
// partial derivative). External wrenches are fixed in body axes.
struct ForwardDynamicsDerivatives {
  Eigen::MatrixXd dq, dqd;
};
// Allocates. forces.armature and forces.added_inertia are constants.
ForwardDynamicsDerivatives forward_dynamics_derivatives(const Model<double>& model,
                                                        const State<double>& x,
                                                        const Forces<double>& forces);

}  // namespace twinarm
