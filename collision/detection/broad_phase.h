// Broad phase: pairs of overlapping axis-aligned bounding boxes.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "collision/geometry/mesh.h"

namespace twinarm {

// Up to 64 boxes: all pairs, O(n^2); more: FCL's dynamic AABB tree, O(n log n + pairs). Both find
// the same pairs. One instance per thread.
class BroadPhase {
 public:
  BroadPhase();
  ~BroadPhase();
  BroadPhase(BroadPhase&&) noexcept;
  BroadPhase& operator=(BroadPhase&&) noexcept;

  // Adds a box. overlaps() takes one box for each call of add(), in the same order.
  void add();
  // All overlapping pairs (i < j), unsorted.
  void overlaps(std::span<const Aabb> boxes, std::vector<std::pair<int, int>>& pairs);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace twinarm
