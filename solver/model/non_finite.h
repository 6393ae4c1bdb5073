// First non-finite variable of aba(), in the order of computation: inputs, pass 1 from base to
// tips, pass 2 from tips to base, pass 3 from base to tips. Locates the origin of a divergence.
// Allocates nothing.
#pragma once

#include "solver/model/workspace.h"

namespace twinarm {

struct NonFiniteField {
  std::size_t body = 0;        // 0: all finite
  const char* name = nullptr;  // Quantity::name
  int pass = 0;                // 0: input
};

NonFiniteField first_bad_quantity(const Model<double>& model, const Forces<double>& forces,
                                  const Workspace<double>& w);

}  // namespace twinarm
