// Compiled twice: with solver/passes/aba.h (TWINARM_ISA = hooked), and with a copy of it from which
// CMake has removed the line of the hook (TWINARM_ISA = bare).
#include "benchmarks/drivers/no_trace_passes.h"

#include "solver/model/configuration.h"
#include "solver/passes/aba.h"

namespace twinarm::bench {
namespace {

void pass(const Model<double>& model, const State<double>& x, const Forces<double>& forces,
          Workspace<double>& w) {
  TWINARM_ISA::aba(model, x, forces, w, NoTrace{});
}

void step(const Model<double>& model, const State<double>& x, const Forces<double>& forces,
          Workspace<double>& w, double h, State<double>& next, std::vector<double>& shift) {
  pass(model, x, forces, w);
  for (std::size_t k = 0; k < model.nv; ++k) {
    next.qd[k] = x.qd[k] + h * w.qdd[k];
    shift[k] = h * next.qd[k];
  }
  integrate_coordinates(model, x.q, shift, next.q);
}

}  // namespace

NoTracePasses TWINARM_PASSES() {
  return {&pass, &step};
}

}  // namespace twinarm::bench
