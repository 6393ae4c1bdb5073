#include "app/render/list/draw_mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>

namespace twinarm {
namespace {

using Triangle = std::array<int, 3>;

// For each vertex the smallest index of an equal vertex.
std::vector<int> weld(const std::vector<Vector3>& vertices) {
  std::map<std::array<double, 3>, int> known;
  std::vector<int> first;
  for (const Vector3& p : vertices) {
    const int index = static_cast<int>(first.size());
    first.push_back(known.try_emplace({p.x(), p.y(), p.z()}, index).first->second);
  }
  return first;
}

struct Facet {
  std::size_t triangle;          // of the mesh
  Triangle vertex;               // welded indices
  Vector3 normal;                // unit length
  std::array<double, 3> weight;  // at each corner: angle times twice the area
};

double angle_between(const Vector3& a, const Vector3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

std::vector<Facet> make_facets(const TriangleMesh& mesh) {
  const std::vector<int> first = weld(mesh.vertices);
  std::vector<Facet> facets;
  facets.reserve(mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    std::array<Vector3, 3> p;
    Facet facet;
    facet.triangle = f;
    for (std::size_t k = 0; k < 3; ++k) {
      assert(t[k] >= 0 && static_cast<std::size_t>(t[k]) < mesh.vertices.size());
      facet.vertex[k] = first[static_cast<std::size_t>(t[k])];
      p[k] = mesh.vertices[static_cast<std::size_t>(t[k])];
    }
    facet.normal = (p[1] - p[0]).cross(p[2] - p[0]);
    const double twice_area = facet.normal.norm();
    if (!(twice_area > 0) || !std::isfinite(twice_area)) continue;
    facet.normal /= twice_area;
    for (std::size_t k = 0; k < 3; ++k)
      facet.weight[k] = twice_area * angle_between(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
    facets.push_back(facet);
  }
  return facets;
}

struct Corner {
  std::size_t facet, corner;
};

std::vector<std::vector<Corner>> corners_by_vertex(const std::vector<Facet>& facets,
                                                   std::size_t vertex_count) {
  std::vector<std::vector<Corner>> around(vertex_count);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k)
      around[static_cast<std::size_t>(facets[f].vertex[k])].push_back({f, k});
  }
  return around;
}

// With more facets at one vertex each keeps its normal: the mean costs the square of their number.
constexpr std::size_t kMaxAround = 512;

// Mean of the normals around a vertex within the crease angle of the corner's facet.
Vector3 normal_at(const Corner& corner, const std::vector<Corner>& around,
                  const std::vector<Facet>& facets) {
  static const double crease_cosine = std::cos(kCreaseAngle);
  const Facet& facet = facets[corner.facet];
  if (around.size() > kMaxAround) return facet.normal;
  Vector3 sum = Vector3::Zero();
  for (const Corner& other : around) {
    const Facet& neighbour = facets[other.facet];
    if (neighbour.normal.dot(facet.normal) >= crease_cosine)
      sum += neighbour.weight[other.corner] * neighbour.normal;
  }
  const double length = sum.norm();  // 0 if all angles underflow
  return length > 0 ? Vector3(sum / length) : facet.normal;
}

std::array<float, 3> to_float(const Vector3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

void set_bounds(DrawMesh& mesh, const std::vector<Vector3>& vertices) {
  if (vertices.empty()) return;
  mesh.bound_center = bounding_box(vertices).center();
  for (const Vector3& p : vertices)
    mesh.bound_radius = std::max(mesh.bound_radius, (p - mesh.bound_center).norm());
}

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

// Of a flat facet with `up` upwards; coordinates from -half to half.
CornerUv on_plane(const Corners& p, const Vector3& normal, const Vector3& up, double half) {
  const Vector3 right = up.cross(normal);
  CornerUv uv;
  for (std::size_t k = 0; k < 3; ++k)
    uv[k] = place(0.5 + 0.5 * right.dot(p[k]) / half, 0.5 - 0.5 * up.dot(p[k]) / half);
  return uv;
}

}  // namespace

Eigen::AlignedBox3d bounding_box(const DrawMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto& p : mesh.positions) box.extend(Vector3(p[0], p[1], p[2]));
  return box;
}

DrawMesh make_draw_mesh(const TriangleMesh& mesh, const std::vector<CornerUv>& uv) {
  assert(uv.empty() || uv.size() == mesh.triangles.size());
  const std::vector<Facet> facets = make_facets(mesh);
  const auto around = corners_by_vertex(facets, mesh.vertices.size());

  DrawMesh result;
  result.triangles.resize(facets.size());
  for (std::size_t v = 0; v < around.size(); ++v) {
    const std::size_t begin = result.positions.size();  // of the vertices made from this one
    for (const Corner& corner : around[v]) {
      const std::array<float, 3> normal = to_float(normal_at(corner, around[v], facets));
      const std::array<float, 2> place =
          uv.empty() ? std::array<float, 2>{} : uv[facets[corner.facet].triangle][corner.corner];
      // Corners with equal normal and texture coordinates share a vertex.
      const std::size_t known = result.positions.size();
      std::size_t index = known - begin > kMaxAround ? known - kMaxAround : begin;
      while (index < result.normals.size() &&
             (result.normals[index] != normal || (!uv.empty() && result.uv[index] != place)))
        ++index;
      if (index == result.normals.size()) {
        result.positions.push_back(to_float(mesh.vertices[v]));
        result.normals.push_back(normal);
        if (!uv.empty()) result.uv.push_back(place);
      }
      result.triangles[corner.facet][corner.corner] = static_cast<std::uint32_t>(index);
    }
  }
  set_bounds(result, mesh.vertices);
  return result;
}

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
  const auto u_of = [](const Vector3& p) {
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
    // Corners on the same side of the border as the facet's centre; those on the axis at its u.
    const double middle = u_of((p[0] + p[1] + p[2]) / 3);
    CornerUv uv;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool on_axis = p[k].head<2>().norm() < 1e-9 * p[k].norm() + 1e-12;
      const double u = on_axis ? middle : u_of(p[k]);
      uv[k] = place(u + std::round(middle - u), down(p[k]));
    }
    places.push_back(uv);
  }
  return places;
}

}  // namespace twinarm
