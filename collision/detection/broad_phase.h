// Which pairs of boxes along the axes overlap.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "collision/shapes/aabb.h"

namespace twinarm {

class BroadPhase {
 public:
  BroadPhase();
  ~BroadPhase();
  BroadPhase(BroadPhase&&) noexcept;
  BroadPhase& operator=(BroadPhase&&) noexcept;

  // One more box; returns its index. Call overlaps() with a box for each.
  int add();
  // All overlapping pairs (i < j), in an order that depends on the shape of the tree: sort them.
  void overlaps(std::span<const Aabb> boxes, std::vector<std::pair<int, int>>& pairs);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace twinarm
