// The first number of aba() that is not finite, in the order in which the passes write: inputs by
// body, then body by body what pass 1 leaves, from the tips what pass 2 leaves, and again from the
// base what pass 3 leaves. Where a run breaks, the cause stands there. Allocates nothing.
#pragma once

#include "solver/model/workspace.h"

namespace twinarm {

struct NonFiniteField {
  std::size_t body = 0;        // 0: all is finite
  const char* name = nullptr;  // as in describe()
  int pass = 0;                // 0: an input
};

NonFiniteField first_bad_quantity(const Model<double>& model, const Forces<double>& forces,
                                  const Workspace<double>& w);

}  // namespace twinarm
