// Table of function pointers: the algorithms for one scalar and one instruction-set level.
#pragma once

#include <span>
#include <vector>

#include "solver/model/workspace.h"

namespace twinarm {

template <class S>
struct Passes {
  void (*aba)(const Model<S>&, const State<S>&, const Forces<S>&, Workspace<S>&);
  void (*rnea)(const Model<S>&, const State<S>&, const std::vector<S>&,
               const std::vector<Force<S>>&, Workspace<S>&);
  void (*crba)(const Model<S>&, const State<S>&, Workspace<S>&, std::span<S>);
  void (*minv_times)(const Model<S>&, const std::vector<S>&, const std::vector<Force<S>>&,
                     Workspace<S>&);
  void (*kinematics)(const Model<S>&, const State<S>&, Workspace<S>&);
};

}  // namespace twinarm
