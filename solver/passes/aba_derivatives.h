// Derivatives of forward dynamics: d qdd = -M^-1 d tau at the qdd of aba(), since inverse dynamics is
// its inverse. d qdd / d tau = M^-1. Interface: solver/dynamics/derivatives.h.
#pragma once

#include "solver/passes/minv_matrix.h"
#include "solver/passes/rnea_derivatives.h"

namespace twinarm::TWINARM_ISA {

// After aba() at the same state and forces.
template <class S>
[[gnu::flatten]] void aba_derivatives(const Model<S>& model, const State<S>& x,
                                      const Forces<S>& forces, Workspace<S>& w,
                                      MatrixWorkspace<S>& m) {
  rnea_derivatives(model, x, forces, w.qdd, w, m);
  minv_matrix(model, w, m);
  multiply(m.Minv, m.dtau, model.nv, 2 * model.nv, m.dqdd);
  for (S& entry : m.dqdd) entry = -entry;
}

}  // namespace twinarm::TWINARM_ISA
