#include "collision/detection/broad_phase.h"

namespace twinarm {

void BroadPhase::overlaps(std::span<const Aabb> boxes, std::vector<std::pair<int, int>>& pairs) {
  constexpr std::size_t kMaxAllPairs = 64;  // boxes
  pairs.clear();
  if (boxes.size() > kMaxAllPairs) {
    if (!tree_) tree_.reset(twinarm_fcl_box_tree());
    tree_->overlaps(boxes, pairs);
    return;
  }
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size(); ++j)
      if (boxes[i].intersects(boxes[j]))
        pairs.emplace_back(static_cast<int>(i), static_cast<int>(j));
}

}  // namespace twinarm
