// Bounding-volume hierarchy: split at the median of the box centres along the longest axis.
#include "collision/detection/mesh_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace twinarm {
namespace {

constexpr int kLeafSize = 4;

// A triangle as a flat hull with two opposite faces.
ConvexHull thin_hull(const Vector3& a, const Vector3& b, const Vector3& c) {
  ConvexHull hull;
  hull.vertices = {a, b, c};
  hull.faces = {{0, 1, 2}, {0, 2, 1}};
  const Vector3 n = (b - a).cross(c - a).normalized();
  hull.normals = {n, -n};
  hull.offsets = {n.dot(a), -n.dot(a)};
  hull.triangles = {{0, 1, 2}, {0, 2, 1}};
  return hull;
}

int build_node(MeshSurface& surface, const std::vector<Aabb>& boxes, int first, int count) {
  Aabb box;
  for (int i = first; i < first + count; ++i) box.extend(boxes[surface.order[i]]);
  const int index = static_cast<int>(surface.nodes.size());
  surface.nodes.push_back({box, first, count});
  if (count <= kLeafSize) return index;
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  const auto begin = surface.order.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [&](int i, int j) {
    const double x = boxes[i].min()[axis] + boxes[i].max()[axis];
    const double y = boxes[j].min()[axis] + boxes[j].max()[axis];
    return std::pair(x, i) < std::pair(y, j);
  });
  const int left = build_node(surface, boxes, first, count / 2);
  const int right = build_node(surface, boxes, first + count / 2, count - count / 2);
  surface.nodes[index].left = left;
  surface.nodes[index].right = right;
  return index;
}

void find_neighbours(const TriangleMesh& mesh, MeshSurface& surface) {
  std::map<std::pair<int, int>, Vector3> outward;  // of each directed edge
  const auto side_of = [&](std::size_t t, int i) {
    const auto& vertices = mesh.triangles[t];
    return std::pair(vertices[i], vertices[(i + 1) % 3]);
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const auto [p, q] = side_of(t, i);
      const Vector3 along = mesh.vertices[q] - mesh.vertices[p];
      outward[{p, q}] = along.cross(surface.normals[t]).normalized();
    }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const auto [p, q] = side_of(t, i);
      const auto beyond = outward.find({q, p});
      surface.sides[t][i] = {outward[{p, q}],
                             beyond == outward.end() ? Vector3(Vector3::Zero()) : beyond->second};
    }
}

}  // namespace

void MeshSurface::find(const Aabb& box, std::vector<int>& found) const {
  std::array<int, 64> stack;  // the tree is balanced
  std::size_t size = 0;
  if (!nodes.empty()) stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes[stack[--size]];
    if (!box.intersects(node.box)) continue;
    if (node.left >= 0) {
      stack[size++] = node.left;
      stack[size++] = node.right;
    } else {
      for (int i = node.first; i < node.first + node.count; ++i) found.push_back(order[i]);
    }
  }
  std::sort(found.begin(), found.end());
}

std::shared_ptr<const MeshSurface> make_mesh_surface(const Shape& shape) {
  const auto* mesh_shape = std::get_if<MeshShape>(&shape);
  if (mesh_shape == nullptr) return nullptr;
  const TriangleMesh& mesh = mesh_shape->mesh;
  auto surface = std::make_shared<MeshSurface>();
  surface->is_open = mesh_shape->is_open;
  std::vector<Aabb> boxes;
  for (const auto& [i, j, k] : mesh.triangles) {
    const ConvexHull hull = thin_hull(mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]);
    boxes.push_back(bounding_box(hull.vertices));
    surface->normals.push_back(hull.normals[0]);
    surface->triangles.emplace_back(Shape(hull));
  }
  surface->sides.resize(mesh.triangles.size());
  find_neighbours(mesh, *surface);
  surface->order.resize(mesh.triangles.size());
  std::iota(surface->order.begin(), surface->order.end(), 0);
  if (!boxes.empty()) build_node(*surface, boxes, 0, static_cast<int>(boxes.size()));
  return surface;
}

}  // namespace twinarm
