// Contact points with a half-space: vertices of a polyhedron, ends of a capsule, centre of a sphere
// (each with the radius), rim points of a cylinder, lowest point of an ellipsoid; depth = offset -
// n . p. O(vertices).
#include "collision/narrow_phase/closed_forms.h"

#include "collision/narrow_phase/manifold.h"

namespace twinarm {
Vector3 outward_W(const PosedShape& half_space) {
  return half_space.X_WG.R * std::get<HalfSpace>(half_space.solid.shape).normal;
}

double half_space_distance(const PosedShape& half_space, const PosedShape& body) {
  const Vector3 n = outward_W(half_space);
  return n.dot(body.support_W(-n) - half_space.X_WG.p) -
         std::get<HalfSpace>(half_space.solid.shape).offset;
}

double half_space_distance(const PosedShape& half_space, const Aabb& box) {
  const Vector3 n = outward_W(half_space);
  return n.dot(box.center() - half_space.X_WG.p) - n.cwiseAbs().dot(box.sizes() / 2) -
         std::get<HalfSpace>(half_space.solid.shape).offset;
}

void half_space_contacts(const PosedShape& half_space, const PosedShape& body, double margin,
                         std::vector<ManifoldPoint>& out) {
  out.clear();
  const Vector3 n = outward_W(half_space);
  const double plane =
      n.dot(half_space.X_WG.p) + std::get<HalfSpace>(half_space.solid.shape).offset;
  const auto add = [&](const Vector3& p, int name) {
    const double depth = plane - n.dot(p);
    if (depth > -margin) out.push_back({p + depth * n, p, depth, name});
  };
  const Polytope& core = body.solid.core;
  if (core.exists) {
    for (std::size_t i = 0; i < core.hull.vertices.size(); ++i)
      add(body.X_WG * core.hull.vertices[i] - core.radius * n, static_cast<int>(i));
  } else {
    std::visit(
        [&](const auto& shape) {
          if constexpr (requires { shape.plane_contact_points(n, add); })
            shape.plane_contact_points(
                -(body.X_WG.R.transpose() * n),
                [&](const Vector3& p_G, int name) { add(body.X_WG * p_G, name); });
          else
            add(body.support_W(-n), 0);
        },
        body.solid.shape);
  }
  reduce_to_four(n, out);
}

}  // namespace twinarm
