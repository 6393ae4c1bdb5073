// Broad phase: of few boxes each with each, O(n^2), of many by FCL's dynamic tree, O(n log n +
// pairs). Both find the same pairs.
//
// To refit and to ask the tree of an arm's 18 hulls and nine obstacles took a ninth of the
// instructions of a servo tick and a seventh of the cache lines that it touched, which counts where
// a thread has slept in between; each with each is 351 comparisons in a row.
//
// FCL would bound a turned body by its bounding sphere. We know tighter boxes and hand them over:
// each object is a stand-in at the identity whose local box is rewritten each step. One instance
// per thread: FCL writes to its objects here.
#include "collision/detection/broad_phase.h"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision_object.h>

#include <algorithm>
#include <cstdint>

namespace twinarm {
namespace {

struct StandIn {
  std::shared_ptr<fcl::Boxd> geometry = std::make_shared<fcl::Boxd>(1.0, 1.0, 1.0);
  std::unique_ptr<fcl::CollisionObjectd> object = std::make_unique<fcl::CollisionObjectd>(geometry);
};

using Pairs = std::vector<std::pair<int, int>>;

constexpr std::size_t kFew = 64;  // boxes

bool meet(const Aabb& a, const Aabb& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

void each_with_each(std::span<const Aabb> boxes, Pairs& pairs) {
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size(); ++j)
      if (meet(boxes[i], boxes[j])) pairs.emplace_back(static_cast<int>(i), static_cast<int>(j));
}

int index_of(const fcl::CollisionObjectd* object) {
  return static_cast<int>(reinterpret_cast<std::intptr_t>(object->getUserData()));
}

bool collect(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
  const int i = index_of(a), j = index_of(b);
  static_cast<Pairs*>(data)->emplace_back(std::min(i, j), std::max(i, j));
  return false;  // go on
}

}  // namespace

struct BroadPhase::Impl {
  std::vector<StandIn> objects;
  fcl::DynamicAABBTreeCollisionManagerd manager;  // after the objects: goes before them
  bool is_new = true;
};

BroadPhase::BroadPhase() : impl_(std::make_unique<Impl>()) {}
BroadPhase::~BroadPhase() = default;
BroadPhase::BroadPhase(BroadPhase&&) noexcept = default;
BroadPhase& BroadPhase::operator=(BroadPhase&&) noexcept = default;

int BroadPhase::add() {
  const auto index = static_cast<std::intptr_t>(impl_->objects.size());
  impl_->objects.emplace_back();
  // NOLINTNEXTLINE(performance-no-int-to-ptr): FCL keeps a pointer for us, nothing else
  impl_->objects.back().object->setUserData(reinterpret_cast<void*>(index));
  impl_->is_new = true;
  return static_cast<int>(index);
}

void BroadPhase::overlaps(std::span<const Aabb> boxes, Pairs& pairs) {
  pairs.clear();
  if (boxes.size() <= kFew) return each_with_each(boxes, pairs);
  for (std::size_t i = 0; i < impl_->objects.size(); ++i) {
    StandIn& stand_in = impl_->objects[i];
    stand_in.geometry->aabb_local = fcl::AABBd(boxes[i].low, boxes[i].high);
    stand_in.object->computeAABB();
  }
  if (impl_->is_new) {  // built over boxes that are already in their places
    impl_->manager.clear();
    for (StandIn& stand_in : impl_->objects) {
      impl_->manager.registerObject(stand_in.object.get());
    }
    impl_->manager.setup();
    impl_->is_new = false;
  } else {
    impl_->manager.update();
  }
  impl_->manager.collide(&pairs, collect);
}

}  // namespace twinarm
