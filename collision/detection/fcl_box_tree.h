// The dynamic AABB tree of FCL, a library that the program opens when it needs it
// (app/command/main/modules.cpp).
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "collision/geometry/mesh.h"

namespace twinarm {

class BoxTree {
 public:
  virtual ~BoxTree() = default;
  // Appends all overlapping pairs (i < j), unsorted. Always of as many boxes.
  virtual void overlaps(std::span<const Aabb> boxes, std::vector<std::pair<int, int>>& pairs) = 0;
};

}  // namespace twinarm

// The caller owns it.
extern "C" [[gnu::visibility("default")]] twinarm::BoxTree* twinarm_fcl_box_tree();
