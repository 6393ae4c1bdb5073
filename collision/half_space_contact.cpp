// A half-space is touched by corners, so the manifold is the list of those that are deep enough:
// vertices of a polyhedron, ends of a capsule, centre of a sphere (each with the radius), points of
// the rim of a cylinder. depth = offset - n . p. FCL gives one point here, which jumps from the
// middle of a face to a corner when the body tilts by 1e-9.  O(vertices).
#include "collision/half_space_contact.h"

#include <algorithm>

#include "collision/manifold.h"

namespace twinarm {
namespace {

constexpr int lowest_name = 1 << 20;  // of the lowest point of a rim

}  // namespace

Vector3 outward_W(const Placed& half_space) {
  return half_space.X_WG.R * std::get<HalfSpace>(half_space.solid.shape).normal;
}

double half_space_distance(const Placed& half_space, const Placed& body) {
  const Vector3 n = outward_W(half_space);
  return n.dot(body.support_W(-n) - half_space.X_WG.p) -
         std::get<HalfSpace>(half_space.solid.shape).offset;
}

void half_space_contacts(const Placed& half_space, const Placed& body, double margin,
                         Feature& scratch, std::vector<ManifoldPoint>& out) {
  out.clear();
  const Vector3 n = outward_W(half_space);
  const double plane =
      n.dot(half_space.X_WG.p) + std::get<HalfSpace>(half_space.solid.shape).offset;
  double deepest = -1e300;
  const auto add = [&](const Vector3& p, int name) {
    const double depth = plane - n.dot(p);
    deepest = std::max(deepest, depth);
    if (depth > -margin) out.push_back({p + depth * n, p, depth, name});
  };
  const Polytope& core = body.solid.core;
  if (core.exists) {
    for (std::size_t i = 0; i < core.hull.vertices.size(); ++i) {
      add(body.X_WG * core.hull.vertices[i] - core.radius * n, static_cast<int>(i));
    }
  } else {
    support_feature(body, -n, scratch);
    for (std::size_t i = 0; i < scratch.points.size(); ++i) {
      add(scratch.points[i], 16 * scratch.id + static_cast<int>(i));
    }
    const Vector3 lowest = body.support_W(-n);
    if (plane - n.dot(lowest) > deepest + 1e-9) add(lowest, lowest_name);
  }
  reduce_to_four(n, out);
}

}  // namespace twinarm
