#include "app/render/list/texture_places.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace twinarm {
namespace {

using Corners = std::array<Vector3, 3>;

Corners corners_of(const TriangleMesh& mesh, std::size_t triangle) {
  Corners p;
  for (std::size_t k = 0; k < 3; ++k)
    p[k] = mesh.vertices[static_cast<std::size_t>(mesh.triangles[triangle][k])];
  return p;
}

Vector3 normal_of(const Corners& p) {
  return (p[1] - p[0]).cross(p[2] - p[0]).normalized();
}

std::array<float, 2> place(double u, double v) {
  return {static_cast<float>(u), static_cast<float>(v)};
}

// A flat facet that is seen from outside with `up` upwards; coordinates from -half to half.
CornerUv on_plane(const Corners& p, const Vector3& normal, const Vector3& up, double half) {
  const Vector3 right = up.cross(normal);
  CornerUv uv;
  for (std::size_t k = 0; k < 3; ++k)
    uv[k] = place(0.5 + 0.5 * right.dot(p[k]) / half, 0.5 - 0.5 * up.dot(p[k]) / half);
  return uv;
}

}  // namespace

std::vector<CornerUv> places_on_box(const TriangleMesh& box) {
  std::vector<CornerUv> places;
  for (std::size_t i = 0; i < box.triangles.size(); ++i) {
    const Corners p = corners_of(box, i);
    const Vector3 n = normal_of(p);
    const bool level = std::abs(n.z()) > 0.5;
    places.push_back(on_plane(p, n, level ? Vector3::UnitY() : Vector3::UnitZ(), 0.5));
  }
  return places;
}

std::vector<CornerUv> places_around_z(const TriangleMesh& mesh,
                                      const std::function<double(const Vector3&)>& down,
                                      double cap) {
  const auto turn_of = [](const Vector3& p) {
    return 0.5 + std::atan2(p.y(), p.x()) / (2 * std::numbers::pi);
  };
  std::vector<CornerUv> places;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Corners p = corners_of(mesh, i);
    const Vector3 n = normal_of(p);
    if (cap > 0 && std::abs(n.z()) > 0.999) {
      places.push_back(on_plane(p, n, Vector3::UnitY(), cap));
      continue;
    }
    // The corners stand beside the facet's middle, also where they are beyond the border; one on
    // the axis, which has no direction of its own, stands at it.
    const double middle = turn_of((p[0] + p[1] + p[2]) / 3);
    CornerUv uv;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool on_axis = p[k].head<2>().norm() < 1e-9 * p[k].norm() + 1e-12;
      const double turn = on_axis ? middle : turn_of(p[k]);
      uv[k] = place(turn + std::round(middle - turn), down(p[k]));
    }
    places.push_back(uv);
  }
  return places;
}

}  // namespace twinarm
