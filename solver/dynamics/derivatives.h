// Derivatives of inverse and forward dynamics by q, qd and tau, analytic, in O(n d).
//
// By q: along q exp(s e_k) at s = 0 (for vector joints the partial derivative). External wrenches
// are fixed in body axes; forces.tau, forces.armature and forces.added_inertia are constants.
#pragma once

#include <Eigen/Core>

#include "solver/dynamics/dynamics.h"

namespace twinarm {

// solver/passes/rnea_derivatives.h: dtau = (d tau/dq, d tau/dqd), nv x 2 nv, row-major; after
// rnea() or aba() at the same state. forces.tau is not used.
inline void rnea_derivatives(const Model<double>& model, const State<double>& x,
                             const Forces<double>& forces, const std::vector<double>& qdd,
                             Workspace<double>& w, MatrixWorkspace<double>& m,
                             std::span<double> dtau) {
  passes<double>().rnea_derivatives(model, x, forces, qdd, w, m, dtau);
}
// solver/passes/aba_derivatives.h, after aba() at the same state and forces.
inline void aba_derivatives(const Model<double>& model, const State<double>& x,
                            const Forces<double>& forces, Workspace<double>& w,
                            MatrixWorkspace<double>& m, AbaDerivatives<double>& out) {
  passes<double>().aba_derivatives(model, x, forces, w, m, out);
}

// The same as matrices nv x nv: d qdd / dq and d qdd / dqd. Allocates.
struct ForwardDynamicsDerivatives {
  Eigen::MatrixXd dq, dqd;
};
ForwardDynamicsDerivatives forward_dynamics_derivatives(const Model<double>& model,
                                                        const State<double>& x,
                                                        const Forces<double>& forces);

}  // namespace twinarm
