// Instantiates the algorithms for one scalar (TWINARM_SCALAR) at one instruction-set level
// (TWINARM_ISA). Compiled once per pair in solver/passes/compiled/CMakeLists.txt.
#include "solver/passes/aba.h"
#include "solver/passes/aba_derivatives.h"
#include "solver/passes/constraint_sweeps.h"
#include "solver/passes/crba.h"
#include "solver/passes/kinematics_pass.h"
#include "solver/passes/minv.h"
#include "solver/passes/pass_table.h"
#include "solver/passes/rnea.h"
#include "solver/spatial/batch.h"
#include "solver/spatial/dual.h"

namespace twinarm::TWINARM_ISA {

template <class S>
const Passes<S>& table();

template <>
const Passes<TWINARM_SCALAR>& table() {
  using S = TWINARM_SCALAR;
  static constexpr Passes<S> all = [](auto passes) {
    if constexpr (std::is_same_v<S, double>) {
      passes.rnea_derivatives = &rnea_derivatives<S>;
      passes.minv_matrix = &minv_matrix<S>;
      passes.constraint_factors = &constraint_factors<S>;
      passes.constraint_forces = &constraint_forces<S>;
      passes.constraint_accelerations = &constraint_accelerations<S>;
      passes.aba_derivatives = &aba_derivatives<S>;
    }
    passes.aba = [](const Model<S>& model, const State<S>& x, const Forces<S>& forces,
                    Workspace<S>& w) { aba(model, x, forces, w, NoTrace{}); };
    passes.rnea = &rnea<S>;
    passes.crba_in_body_axes = &crba_in_body_axes<S>;
    passes.crba_in_common_axes = &crba_in_common_axes<S>;
    passes.minv_times = &minv_times<S>;
    passes.kinematics = &kinematics<S>;
    return passes;
  }(Passes<S>{});
  return all;
}

}  // namespace twinarm::TWINARM_ISA
