// Narrow phase, in this order:
//   1. closed forms: half-space or cavity with any shape, sphere and capsule pairs, sphere-box,
//      sphere-cylinder;
//   2. the best face normal, if the contact area proves that no other direction has a smaller
//   overlap
//      (manifold.cpp): resting contacts end here, without GJK;
//   3. polytopes with a radius: GJK distance of the cores; if they touch or overlap, all separating
//      axes; the smaller overlap counts;
//   4. cylinders and ellipsoids: curved_axis.h.
// Every direction is evaluated by overlap(n) of the true shapes, an upper bound of the depth for
// any n: a search that ends early costs optimality, not consistency, and is detected by the duality
// gap. Cost: closed forms 0.1 us, boxes face on face 0.6 us, otherwise 2-30 us; hulls with hundreds
// of vertices 10-100 us.
#include "collision/narrow_phase/narrow_phase.h"

#include <Eigen/Geometry>

namespace twinarm {
namespace {

constexpr double kWellApart = 1e-6;  // above it the nearest points define the direction [m]

bool is_half_space(const PosedShape& body) {
  return std::holds_alternative<HalfSpace>(body.solid.shape);
}

}  // namespace

bool is_supported(const Shape& a, const Shape& b) {
  const auto is_surface = [](const Shape& s) {
    return std::holds_alternative<HalfSpace>(s) || std::holds_alternative<MeshShape>(s) ||
           is_hollow(s);
  };
  return !(is_surface(a) && is_surface(b));
}

bool NarrowPhase::nearest(const PosedShape& a, const PosedShape& b, double margin,
                          NearestPair& pair) {
  if (const auto closed = round_contact(a, b)) {
    pair = *closed;
    return pair.axis.overlap > -margin;
  }
  if (!a.solid.core.exists || !b.solid.core.exists) return curved_.nearest(a, b, margin, pair);
  const double radii = a.solid.core.radius + b.solid.core.radius;
  const CoreDistance cores = core_distance(a, b, margin + radii);
  const bool apart = cores.distance > kMinGjkDistance;
  PenetrationDirection best;  // of the cores, until the end
  if (apart) {
    best = {cores.n_W, overlap(a, b, cores.n_W) - radii};
    if (best.overlap + radii < -margin) return false;
  }
  const bool is_known =
      cores.distance > kWellApart && !has_duality_gap(cores.distance, best.overlap);
  if (!is_known) separating_axis_.improve(a, b, cores.distance, best);
  best.overlap += radii;
  pair.axis = best;
  pair.p_W = mean_of_supports(a, b, best.n_W);
  if (apart && cores.n_W.dot(best.n_W) > 0.99)
    pair.p_W = midway(a, b, best.n_W, 0.5 * (cores.p_WA + cores.p_WB));
  return pair.axis.overlap > -margin;
}

NarrowPhase::Result NarrowPhase::contacts(const PosedShape& a, const PosedShape& b, double margin) {
  if (is_half_space(a) || is_half_space(b)) {
    const bool a_is_ground = is_half_space(a);
    const PosedShape& ground = a_is_ground ? a : b;
    half_space_contacts(ground, a_is_ground ? b : a, margin, points_);
    if (!a_is_ground) swap_roles(points_);
    return {a_is_ground ? outward_W(ground) : Vector3(-outward_W(ground)), &points_};
  }
  if (is_hollow(a.solid.shape) || is_hollow(b.solid.shape)) {
    const bool a_is_hollow = is_hollow(a.solid.shape);
    cavity_contacts(a_is_hollow ? a : b, a_is_hollow ? b : a, margin, points_);
    if (!a_is_hollow) swap_roles(points_);
    return {Vector3::Zero(), &points_};
  }
  NearestPair pair;
  if (const auto closed = round_contact(a, b)) {
    pair = *closed;
    if (!(pair.axis.overlap > -margin)) return {};
  } else {
    PenetrationDirection flat;
    if (!face_axis_.best(a, b, margin, flat)) return {};
    if (!flat.n_W.isZero(0) && manifold_.certify_face_contact(a, b, flat))
      return {flat.n_W, &manifold_.points(flat, margin)};
    if (!nearest(a, b, margin, pair)) return {};
  }
  return contacts(a, b, pair, margin);
}

double NarrowPhase::distance(const PosedShape& a, const PosedShape& b) {
  if (is_half_space(a)) return half_space_distance(a, b);
  if (is_half_space(b)) return half_space_distance(b, a);
  if (is_hollow(a.solid.shape)) return cavity_distance(a, b, points_);
  if (is_hollow(b.solid.shape)) return cavity_distance(b, a, points_);
  NearestPair pair;
  nearest(a, b, 1e300, pair);
  return -pair.axis.overlap;
}

}  // namespace twinarm
