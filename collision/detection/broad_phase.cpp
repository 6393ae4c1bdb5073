#include "collision/detection/broad_phase.h"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision_object.h>

#include <algorithm>
#include <cstdint>

namespace twinarm {
namespace {

// FCL would bound a rotated body by its bounding sphere. Each object is therefore a box at the
// identity pose whose local AABB is overwritten with ours before each update.
struct TreeObject {
  std::shared_ptr<fcl::Boxd> geometry = std::make_shared<fcl::Boxd>(1.0, 1.0, 1.0);
  std::unique_ptr<fcl::CollisionObjectd> object = std::make_unique<fcl::CollisionObjectd>(geometry);
};

using Pairs = std::vector<std::pair<int, int>>;

constexpr std::size_t kMaxAllPairs = 64;  // boxes

void test_all_pairs(std::span<const Aabb> boxes, Pairs& pairs) {
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size(); ++j)
      if (boxes[i].intersects(boxes[j]))
        pairs.emplace_back(static_cast<int>(i), static_cast<int>(j));
}

int index_of(const fcl::CollisionObjectd* object) {
  return static_cast<int>(reinterpret_cast<std::intptr_t>(object->getUserData()));
}

bool collect(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
  const int i = index_of(a), j = index_of(b);
  static_cast<Pairs*>(data)->emplace_back(std::min(i, j), std::max(i, j));
  return false;  // continue
}

}  // namespace

struct BroadPhase::Impl {
  std::vector<TreeObject> objects;
  fcl::DynamicAABBTreeCollisionManagerd manager;  // refers to objects: destroyed first
  bool is_new = true;
};

BroadPhase::BroadPhase() : impl_(std::make_unique<Impl>()) {}
BroadPhase::~BroadPhase() = default;
BroadPhase::BroadPhase(BroadPhase&&) noexcept = default;
BroadPhase& BroadPhase::operator=(BroadPhase&&) noexcept = default;

void BroadPhase::add() {
  const auto index = static_cast<std::intptr_t>(impl_->objects.size());
  impl_->objects.emplace_back();
  // NOLINTNEXTLINE(performance-no-int-to-ptr): FCL stores it and does not dereference it
  impl_->objects.back().object->setUserData(reinterpret_cast<void*>(index));
  impl_->is_new = true;
}

void BroadPhase::overlaps(std::span<const Aabb> boxes, Pairs& pairs) {
  pairs.clear();
  if (boxes.size() <= kMaxAllPairs) return test_all_pairs(boxes, pairs);
  for (std::size_t i = 0; i < impl_->objects.size(); ++i) {
    TreeObject& object = impl_->objects[i];
    object.geometry->aabb_local = fcl::AABBd(boxes[i].min(), boxes[i].max());
    object.object->computeAABB();
  }
  if (impl_->is_new) {  // builds the tree from boxes in their actual positions
    impl_->manager.clear();
    std::vector<fcl::CollisionObjectd*> all;
    for (TreeObject& object : impl_->objects) all.push_back(object.object.get());
    impl_->manager.registerObjects(all);  // O(n log n), unlike one by one
    impl_->manager.setup();
    impl_->is_new = false;
  } else {
    impl_->manager.update();
  }
  impl_->manager.collide(&pairs, collect);
}

}  // namespace twinarm
