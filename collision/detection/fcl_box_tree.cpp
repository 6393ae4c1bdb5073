// FCL's broad phase; its narrow phase: fcl_contact.cpp. No other file includes FCL.
#include "collision/detection/fcl_box_tree.h"

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

int index_of(const fcl::CollisionObjectd* object) {
  return static_cast<int>(reinterpret_cast<std::intptr_t>(object->getUserData()));
}

bool collect(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
  const int i = index_of(a), j = index_of(b);
  static_cast<Pairs*>(data)->emplace_back(std::min(i, j), std::max(i, j));
  return false;  // continue
}

class FclBoxTree final : public BoxTree {
 public:
  void overlaps(std::span<const Aabb> boxes, Pairs& pairs) override {
    const bool is_new = objects_.empty();
    if (is_new) objects_.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      TreeObject& object = objects_[i];
      object.geometry->aabb_local = fcl::AABBd(boxes[i].min(), boxes[i].max());
      object.object->computeAABB();
    }
    if (is_new)  // builds the tree from boxes in their actual positions
      register_objects();
    else
      manager_.update();
    manager_.collide(&pairs, collect);
  }

 private:
  void register_objects() {
    std::vector<fcl::CollisionObjectd*> all;
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      all.push_back(objects_[i].object.get());
      // NOLINTNEXTLINE(performance-no-int-to-ptr): FCL stores it and does not dereference it
      all.back()->setUserData(reinterpret_cast<void*>(static_cast<std::intptr_t>(i)));
    }
    manager_.registerObjects(all);  // O(n log n), unlike one by one
    manager_.setup();
  }

  std::vector<TreeObject> objects_;
  fcl::DynamicAABBTreeCollisionManagerd manager_;  // refers to objects_: destroyed first
};

}  // namespace
}  // namespace twinarm

twinarm::BoxTree* twinarm_fcl_box_tree() {
  return new twinarm::FclBoxTree;
}
