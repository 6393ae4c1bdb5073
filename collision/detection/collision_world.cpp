// One detection: boxes -> broad phase -> filter -> narrow phase -> sorted contacts.
// Cost: O(n log n) for the boxes, plus the narrow phase of the pairs whose boxes overlap.
#include "collision/detection/collision_world.h"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision_object.h>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <tuple>

#include "collision/narrow_phase/narrow_phase.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

bool is_half_space(const Shape& shape) {
  return std::holds_alternative<HalfSpace>(shape);
}

bool is_finite(const Pose& X) {
  return X.R.allFinite() && X.p.allFinite();
}

// The box of a body, grown by its margin: two boxes overlap if the bodies can be that near.
Aabb bounding_box(const PosedShape& body, double margin) {
  constexpr std::size_t kSmallCount =
      7;  // vertices, of which the least box is as cheap as any other
  Aabb box;
  const Polytope& core = body.solid.core;
  if (body.solid.surface || (core.exists && core.hull.vertices.size() > kSmallCount)) {
    // Around the box in the body's own axes, which does not ask every vertex: wider, but of a box.
    const Vector3 centre = body.X_WG * body.solid.centre;
    const Vector3 half = body.X_WG.R.cwiseAbs() * body.solid.half;
    box = {centre - half, centre + half};
  } else if (core.exists) {
    box.low = box.high = body.X_WG * core.hull.vertices[0];
    for (const Vector3& v : core.hull.vertices) {
      const Vector3 p = body.X_WG * v;
      box.low = box.low.cwiseMin(p);
      box.high = box.high.cwiseMax(p);
    }
    margin += core.radius;
  } else {
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 e = Vector3::Unit(axis);
      box.high[axis] = body.support_W(e)[axis];
      box.low[axis] = body.support_W(-e)[axis];
    }
  }
  return {box.low.array() - margin, box.high.array() + margin};
}

}  // namespace

int CollisionWorld::add(Geometry geometry) {
  const std::string where = "geometry '" + geometry.name + "'";
  DiagnosticList faults;
  const std::string fault = shape_fault(geometry.shape);
  if (!fault.empty())
    faults.add(where, shape_name(geometry.shape) + ": " + fault, "correct the shape",
               "shape.numbers");
  if (geometry.group < 0 || geometry.group >= group_count)
    faults.add(where, "group is " + std::to_string(geometry.group),
               "give a group from 0 to " + std::to_string(group_count - 1), "contact.group");
  faults.check();

  const int id = size();
  geometries_.push_back(std::move(geometry));
  try {
    for (int other = 0; other < id; ++other) check_pair(other, id);
    solids_.emplace_back(geometries_.back().shape);
  } catch (...) {
    geometries_.pop_back();
    throw;
  }
  if (is_half_space(geometries_.back().shape)) {
    half_spaces_.push_back(id);
  } else {
    bounded_.push_back(id);
    broad_phase_.add();
  }
  return id;
}

void CollisionWorld::check_pair(int a, int b) const {
  if (!may_collide(a, b) || is_supported(geometry(a).shape, geometry(b).shape)) return;
  throw InputError(
      {{"", 0, "geometries '" + geometry(a).name + "' and '" + geometry(b).name + "'",
        "a " + shape_name(geometry(a).shape) + " cannot collide with a " +
            shape_name(geometry(b).shape),
        "keep their groups apart with set_group_filter() before adding them, or fix both",
        "contact.pair"}});
}

void CollisionWorld::disable_pair(int a, int b) {
  assert(a >= 0 && b >= 0 && a < size() && b < size());
  const std::pair pair(std::min(a, b), std::max(a, b));
  const auto place = std::lower_bound(disabled_pairs_.begin(), disabled_pairs_.end(), pair);
  if (place == disabled_pairs_.end() || *place != pair) disabled_pairs_.insert(place, pair);
}

void CollisionWorld::set_group_filter(int group_a, int group_b, bool collide) {
  for (int group : {group_a, group_b}) {
    if (group < 0 || group >= group_count) {
      throw InputError(
          {{"", 0, "group filter", "group is " + std::to_string(group),
            "give a group from 0 to " + std::to_string(group_count - 1), "contact.group"}});
    }
  }
  const auto before = mask_;
  const std::uint32_t bit_a = 1u << group_a, bit_b = 1u << group_b;
  mask_[group_a] = collide ? mask_[group_a] | bit_b : mask_[group_a] & ~bit_b;
  mask_[group_b] = collide ? mask_[group_b] | bit_a : mask_[group_b] & ~bit_a;
  try {
    for (int i = 0; i < size(); ++i) {
      for (int j = 0; j < i; ++j) check_pair(j, i);
    }
  } catch (...) {
    mask_ = before;
    throw;
  }
}

bool CollisionWorld::may_collide(int a, int b) const {
  const bool groups = (mask_[geometry(a).group] >> geometry(b).group) & 1u;
  return groups && a != b && !(geometry(a).is_fixed && geometry(b).is_fixed) &&
         !std::binary_search(disabled_pairs_.begin(), disabled_pairs_.end(),
                             std::pair(std::min(a, b), std::max(a, b)));
}

// Fills pairs_ with what may touch, ascending.
void CollisionWorld::find_pairs(std::span<const Pose> X_WG, std::span<const double> margins) {
  boxes_.clear();
  for (int id : bounded_) {
    // What is nowhere goes far away: a box that is not a number would unsettle the whole tree.
    const Aabb nowhere{Vector3::Constant(1e30), Vector3::Constant(1e30)};
    boxes_.push_back(is_finite(X_WG[id]) ? bounding_box({solids_[id], X_WG[id]}, margins[id])
                                         : nowhere);
  }
  broad_phase_.overlaps(boxes_, pairs_);
  for (auto& [a, b] : pairs_) {
    a = bounded_[a];
    b = bounded_[b];
  }
  for (int ground : half_spaces_) {
    if (!is_finite(X_WG[ground])) continue;
    const PosedShape half_space{solids_[ground], X_WG[ground]};
    for (std::size_t i = 0; i < bounded_.size(); ++i) {
      const int body = bounded_[i];
      if (half_space_distance(half_space, boxes_[i]) > margins[ground]) continue;
      if (!may_collide(ground, body) || !is_finite(X_WG[body])) continue;
      const PosedShape other{solids_[body], X_WG[body]};
      if (half_space_distance(half_space, other) < margins[ground] + margins[body]) {
        pairs_.emplace_back(std::min(ground, body), std::max(ground, body));
      }
    }
  }
  std::erase_if(pairs_, [&](const auto& pair) {
    return !may_collide(pair.first, pair.second) || !is_finite(X_WG[pair.first]) ||
           !is_finite(X_WG[pair.second]);
  });
  std::sort(pairs_.begin(), pairs_.end());
}

NarrowPhase::Result CollisionWorld::narrow(const PosedShape& a, const PosedShape& b,
                                           double margin) {
  if (a.solid.surface != nullptr) {
    return {Vector3::Zero(), &mesh_contact_.contacts(narrow_phase_, a, b, margin)};
  }
  if (b.solid.surface == nullptr) return narrow_phase_.contacts(a, b, margin);
  points_ = mesh_contact_.contacts(narrow_phase_, b, a, margin);
  swap_roles(points_);
  return {Vector3::Zero(), &points_};
}

void CollisionWorld::collide_pair(int a, int b, std::span<const Pose> X_WG, double margin,
                                  std::vector<Contact>& out) {
  const auto result = narrow({solids_[a], X_WG[a]}, {solids_[b], X_WG[b]}, margin);
  if (result.empty()) return;
  const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(out.size());
  for (const ManifoldPoint& point : *result.points) {
    const Vector3& n_W = result.n_W.isZero(0) ? point.n_W : result.n_W;
    out.push_back({a, b, 0.5 * (point.p_WA + point.p_WB), n_W, point.depth, point.feature});
  }
  std::sort(out.begin() + first, out.end(), [](const Contact& x, const Contact& y) {
    return std::tie(x.feature, y.depth) < std::tie(y.feature, x.depth);
  });
}

void CollisionWorld::detect(std::span<const Pose> X_WG, std::span<const double> margins,
                            std::vector<Contact>& out) {
  assert(static_cast<int>(X_WG.size()) == size() && margins.size() == X_WG.size());
  out.clear();
  find_pairs(X_WG, margins);
  for (const auto& [a, b] : pairs_) collide_pair(a, b, X_WG, margins[a] + margins[b], out);
}

void CollisionWorld::detect(std::span<const Pose> X_WG, double margin, std::vector<Contact>& out) {
  margins_.assign(X_WG.size(), margin / 2);
  detect(X_WG, margins_, out);
}

double CollisionWorld::distance(int a, int b, const Pose& X_WA, const Pose& X_WB) {
  assert(is_supported(geometry(a).shape, geometry(b).shape));
  const PosedShape placed_a{solids_[a], X_WA}, placed_b{solids_[b], X_WB};
  if (solids_[a].surface != nullptr) {
    return mesh_contact_.distance(narrow_phase_, placed_a, placed_b);
  }
  if (solids_[b].surface != nullptr) {
    return mesh_contact_.distance(narrow_phase_, placed_b, placed_a);
  }
  return narrow_phase_.distance(placed_a, placed_b);
}

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
namespace {

struct StandIn {
  std::shared_ptr<fcl::Boxd> geometry = std::make_shared<fcl::Boxd>(1.0, 1.0, 1.0);
  std::unique_ptr<fcl::CollisionObjectd> object = std::make_unique<fcl::CollisionObjectd>(geometry);
};

using Pairs = std::vector<std::pair<int, int>>;

constexpr std::size_t kSmallCount = 64;  // boxes

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
  if (boxes.size() <= kSmallCount) return each_with_each(boxes, pairs);
  for (std::size_t i = 0; i < impl_->objects.size(); ++i) {
    StandIn& stand_in = impl_->objects[i];
    stand_in.geometry->aabb_local = fcl::AABBd(boxes[i].low, boxes[i].high);
    stand_in.object->computeAABB();
  }
  if (impl_->is_new) {  // built over boxes that are already in their places
    impl_->manager.clear();
    for (StandIn& stand_in : impl_->objects) impl_->manager.registerObject(stand_in.object.get());
    impl_->manager.setup();
    impl_->is_new = false;
  } else {
    impl_->manager.update();
  }
  impl_->manager.collide(&pairs, collect);
}

}  // namespace twinarm
