// Detection: bounding boxes -> broad phase -> pair filter -> narrow phase -> sorted contacts.
#include "collision/detection/collision_world.h"

#include <algorithm>
#include <cassert>
#include <tuple>

#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

bool is_finite(const Pose& X) {
  return X.R.allFinite() && X.p.allFinite();
}

// Axis-aligned bounding box, grown by the margin.
Aabb broad_phase_box(const PosedShape& body, double margin) {
  constexpr std::size_t kSmallHull = 7;  // vertices: the tight box is as cheap
  const Polytope& core = body.solid.core;
  if (body.solid.surface || (core.exists && core.hull.vertices.size() > kSmallHull)) {
    // Box around the body's local bounding box: independent of the number of vertices, but wider.
    const Vector3 centre = body.X_WG * body.solid.centre;
    const Vector3 half = body.X_WG.R.cwiseAbs() * body.solid.half;
    return {centre - half - Vector3::Constant(margin), centre + half + Vector3::Constant(margin)};
  }
  if (!core.exists) return bounding_box(body, margin);
  Aabb box;
  for (const Vector3& v : core.hull.vertices) box.extend(body.X_WG * v);
  const Vector3 grown = Vector3::Constant(margin + core.radius);
  return {box.min() - grown, box.max() + grown};
}

}  // namespace

int CollisionWorld::add(Geometry geometry) {
  if (const std::string fault = shape_fault(geometry.shape); !fault.empty())
    throw InputError("geometry '" + geometry.name + "'", shape_name(geometry.shape) + ": " + fault,
                     "correct the shape", "shape.numbers");

  const int id = size();
  geometries_.push_back(std::move(geometry));
  try {
    if (!is_supported(geometries_.back().shape, geometries_.back().shape))
      for (int other = 0; other < id; ++other) check_pair(other, id);
    solids_.emplace_back(geometries_.back().shape);
    if (fcl_) fcl_->add(geometries_.back().shape);
  } catch (...) {
    geometries_.pop_back();
    throw;
  }
  if (std::holds_alternative<HalfSpace>(geometries_.back().shape)) {
    half_spaces_.push_back(id);
  } else {
    bounded_.push_back(id);
    tree_.reset();
  }
  return id;
}

void CollisionWorld::check_pair(int a, int b) const {
  if (!may_collide(a, b) || is_supported(geometry(a).shape, geometry(b).shape)) return;
  throw InputError("geometries '" + geometry(a).name + "' and '" + geometry(b).name + "'",
                   "a " + shape_name(geometry(a).shape) + " cannot collide with a " +
                       shape_name(geometry(b).shape),
                   "give both one group other than 0, or fix both", "contact.pair");
}

bool CollisionWorld::may_collide(int a, int b) const {
  const bool one_group = geometry(a).group != 0 && geometry(a).group == geometry(b).group;
  const bool one_body = geometry(a).body >= 0 && geometry(a).body == geometry(b).body;
  return a != b && !one_group && !one_body &&
         !(is_excluded_ && is_excluded_(std::min(a, b), std::max(a, b)));
}

// Broad phase: fills pairs_ with all overlapping pairs of boxes_ (i < j), unsorted. Up to 64 boxes
// in O(n^2); more by FCL's dynamic AABB tree, O(n log n + pairs). Both find the same pairs.
void CollisionWorld::find_overlaps() {
  constexpr std::size_t kMaxAllPairs = 64;  // boxes
  pairs_.clear();
  if (boxes_.size() > kMaxAllPairs) {
    if (!tree_) tree_.reset(twinarm_fcl_box_tree());
    return tree_->overlaps(boxes_, pairs_);
  }
  for (std::size_t i = 0; i < boxes_.size(); ++i)
    for (std::size_t j = i + 1; j < boxes_.size(); ++j)
      if (boxes_[i].intersects(boxes_[j]))
        pairs_.emplace_back(static_cast<int>(i), static_cast<int>(j));
}

// Fills pairs_ with the collision pairs, ascending.
void CollisionWorld::find_pairs(std::span<const Pose> X_WG, std::span<const double> margins) {
  boxes_.clear();
  // Poses that are not finite: far away, since NaN would corrupt the tree.
  const Aabb nowhere(Vector3::Constant(1e30), Vector3::Constant(1e30));
  for (int id : bounded_)
    boxes_.push_back(is_finite(X_WG[id]) ? broad_phase_box({solids_[id], X_WG[id]}, margins[id])
                                         : nowhere);
  find_overlaps();
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
      if (half_space_distance(half_space, other) < margins[ground] + margins[body])
        pairs_.emplace_back(std::min(ground, body), std::max(ground, body));
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
  if (a.solid.surface != nullptr)
    return {Vector3::Zero(), &mesh_contact_.contacts(narrow_phase_, a, b, margin)};
  if (b.solid.surface == nullptr) return narrow_phase_.contacts(a, b, margin);
  points_ = mesh_contact_.contacts(narrow_phase_, b, a, margin);
  swap_roles(points_);
  return {Vector3::Zero(), &points_};
}

void CollisionWorld::use_fcl() {
  fcl_.reset(twinarm_fcl_contact());
  last_ = {};
  for (const Geometry& geometry : geometries_) fcl_->add(geometry.shape);
}

NarrowPhase::Result CollisionWorld::narrow_by_fcl(int a, int b, std::span<const Pose> X_WG,
                                                  double margin) {
  using Answer = FclContact::Answer;
  const PosedShape at_a{solids_[a], X_WG[a]}, at_b{solids_[b], X_WG[b]};
  NearestPair pair;
  const Answer answer = fcl_->nearest(a, b, at_a, at_b, margin, pair);
  fcl_use_.queries += answer != Answer::none;
  fcl_use_.rejected += answer == Answer::rejected;
  if (answer == Answer::apart) return {};
  if (answer == Answer::contact) return narrow_phase_.contacts(at_a, at_b, pair, margin);
  return narrow(at_a, at_b, margin);
}

void CollisionWorld::collide_pair(int a, int b, std::span<const Pose> X_WG, double margin,
                                  std::vector<Contact>& out) {
  const auto result = fcl_ ? narrow_by_fcl(a, b, X_WG, margin)
                           : narrow({solids_[a], X_WG[a]}, {solids_[b], X_WG[b]}, margin);
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
  find_moved(X_WG, margins);
  find_pairs(X_WG, margins);
  auto known = last_.pairs.begin();
  auto contact = last_.contacts.begin();
  for (const std::pair<int, int>& pair : pairs_) {
    const auto [a, b] = pair;
    if (!moved_[a] && !moved_[b]) known = std::lower_bound(known, last_.pairs.end(), pair);
    if (moved_[a] || moved_[b] || known == last_.pairs.end() || *known != pair) {
      collide_pair(a, b, X_WG, margins[a] + margins[b], out);
      continue;
    }
    const auto key = [](const Contact& c) { return std::pair(c.a, c.b); };
    contact = std::lower_bound(contact, last_.contacts.end(), pair,
                               [&](const Contact& c, const auto& p) { return key(c) < p; });
    for (; contact != last_.contacts.end() && key(*contact) == pair; ++contact)
      out.push_back(*contact);
  }
  last_.pairs.swap(pairs_);
  last_.contacts = out;
}

void CollisionWorld::find_moved(std::span<const Pose> X_WG, std::span<const double> margins) {
  const auto count = static_cast<std::size_t>(size());
  if (last_.X_WG.size() != count) last_ = {};
  moved_.resize(count);
  for (std::size_t id = 0; id < count; ++id)
    moved_[id] = last_.X_WG.empty() || margins[id] != last_.margins[id] ||
                 X_WG[id].R != last_.X_WG[id].R || X_WG[id].p != last_.X_WG[id].p;
  last_.X_WG.assign(X_WG.begin(), X_WG.end());
  last_.margins.assign(margins.begin(), margins.end());
}

void CollisionWorld::detect(std::span<const Pose> X_WG, double margin, std::vector<Contact>& out) {
  margins_.assign(X_WG.size(), margin / 2);
  detect(X_WG, margins_, out);
}

double CollisionWorld::distance(int a, int b, const Pose& X_WA, const Pose& X_WB) {
  assert(is_supported(geometry(a).shape, geometry(b).shape));
  const PosedShape placed_a{solids_[a], X_WA}, placed_b{solids_[b], X_WB};
  if (solids_[a].surface != nullptr)
    return mesh_contact_.distance(narrow_phase_, placed_a, placed_b);
  if (solids_[b].surface != nullptr)
    return mesh_contact_.distance(narrow_phase_, placed_b, placed_a);
  return narrow_phase_.distance(placed_a, placed_b);
}

}  // namespace twinarm
