// One detection: boxes -> broad phase -> filter -> narrow phase -> sorted contacts.
// Cost: O(n log n) for the boxes, plus the narrow phase of the pairs whose boxes overlap.
#include "collision/detection/collision_world.h"

#include <algorithm>
#include <cassert>
#include <tuple>

#include "collision/narrow_phase/closed_forms.h"
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
Aabb bounding_box(const Placed& body, double margin) {
  constexpr std::size_t kFew = 7;  // vertices, of which the least box is as cheap as any other
  Aabb box;
  const Polytope& core = body.solid.core;
  if (body.solid.surface || (core.exists && core.hull.vertices.size() > kFew)) {
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
  FaultList faults;
  const std::string fault = shape_fault(geometry.shape);
  if (!fault.empty()) {
    faults.add(where, shape_name(geometry.shape) + ": " + fault, "correct the shape");
  }
  if (geometry.group < 0 || geometry.group >= group_count) {
    faults.add(where, "group is " + std::to_string(geometry.group),
               "give a group from 0 to " + std::to_string(group_count - 1));
  }
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
        "keep their groups apart with set_group_filter() before adding them, or fix both"}});
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
      throw InputError({{"", 0, "group filter", "group is " + std::to_string(group),
                         "give a group from 0 to " + std::to_string(group_count - 1)}});
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
    const Placed half_space{solids_[ground], X_WG[ground]};
    for (std::size_t i = 0; i < bounded_.size(); ++i) {
      const int body = bounded_[i];
      if (half_space_distance(half_space, boxes_[i]) > margins[ground]) continue;
      if (!may_collide(ground, body) || !is_finite(X_WG[body])) continue;
      const Placed other{solids_[body], X_WG[body]};
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

NarrowPhase::Result CollisionWorld::narrow(const Placed& a, const Placed& b, double margin) {
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
  const Placed placed_a{solids_[a], X_WA}, placed_b{solids_[b], X_WB};
  if (solids_[a].surface != nullptr) {
    return mesh_contact_.distance(narrow_phase_, placed_a, placed_b);
  }
  if (solids_[b].surface != nullptr) {
    return mesh_contact_.distance(narrow_phase_, placed_b, placed_a);
  }
  return narrow_phase_.distance(placed_a, placed_b);
}

}  // namespace twinarm
