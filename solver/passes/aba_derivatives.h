// Derivatives of forward dynamics: d qdd = -M^-1 d tau at the qdd of aba(), since inverse dynamics
// is its inverse. d qdd / d tau = M^-1. Interface: solver/dynamics/derivatives.h.
#pragma once

#include "solver/passes/minv_matrix.h"
#include "solver/passes/rnea_derivatives.h"

namespace twinarm::TWINARM_ISA {

// After aba() at the same state and forces.
template <class S>
[[gnu::flatten]] void aba_derivatives(const Model<S>& model, const State<S>& x,
                                      const Forces<S>& forces, Workspace<S>& w,
                                      MatrixWorkspace<S>& m, AbaDerivatives<S>& out) {
  rnea_derivatives(model, x, forces, w.qdd, w, m, std::span(out.dtau));
  minv_of_factors(model, w, m, std::span(out.Minv));
  multiply(out.Minv, out.dtau, model.nv, 2 * model.nv, out.dqdd);
  for (S& entry : out.dqdd) entry = -entry;
}

}  // namespace twinarm::TWINARM_ISA
