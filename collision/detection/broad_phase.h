// Broad phase: pairs of overlapping axis-aligned bounding boxes.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "collision/detection/fcl_box_tree.h"
#include "collision/geometry/mesh.h"

namespace twinarm {

// Up to 64 boxes: all pairs, O(n^2); more: FCL's dynamic AABB tree, O(n log n + pairs). Both find
// the same pairs. One instance per thread.
class BroadPhase {
 public:
  // Adds a box. overlaps() takes one box for each call of add(), in the same order.
  void add() { tree_.reset(); }
  // All overlapping pairs (i < j), unsorted.
  void overlaps(std::span<const Aabb> boxes, std::vector<std::pair<int, int>>& pairs);

 private:
  std::unique_ptr<BoxTree> tree_;  // null until it is needed
};

}  // namespace twinarm
