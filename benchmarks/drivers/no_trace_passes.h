// aba() with the trace hook, and the same code without it, compiled with the same options.
#pragma once

#include <vector>

#include "solver/model/workspace.h"

namespace twinarm::bench {

struct NoTracePasses {
  void (*pass)(const Model<double>&, const State<double>&, const Forces<double>&,
               Workspace<double>&);
  // A semi-implicit step of h from x to next.
  void (*step)(const Model<double>&, const State<double>& x, const Forces<double>&,
               Workspace<double>&, double h, State<double>& next, std::vector<double>& shift);
};
NoTracePasses hooked_passes();  // solver/passes/aba.h, with NoTrace
NoTracePasses bare_passes();    // the same without the line of the hook

}  // namespace twinarm::bench
