// Whether all engines compute the same: without it no time means anything.
#pragma once

#include <string>
#include <vector>

#include "benchmarks/engines/engine.h"

namespace twinarm::bench {

struct Agreement {
  std::string engine, model;
  double error = 0;          // of qdd, against the first engine, relative to its largest entry
  double error_inverse = 0;  // of the joints' tau by inverse dynamics, likewise; 0 without it
  double tolerance = 0;
  bool holds() const { return error <= tolerance && error_inverse <= tolerance; }
};

// Of every engine against the first, the worst of all situations. They are loaded and have them.
std::vector<Agreement> compare(Engines& engines, const Scene& mechanism,
                               const std::vector<Situation>& situations);

}  // namespace twinarm::bench
