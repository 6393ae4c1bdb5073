// Triangle meshes and support points.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "solver/spatial/pose.h"

namespace twinarm {

struct TriangleMesh {
  std::vector<Vector3> vertices;              // [m], link frame
  std::vector<std::array<int, 3>> triangles;  // counter-clockwise seen from outside
};

using Aabb = Eigen::AlignedBox3d;  // axis-aligned bounding box [m]
Aabb bounding_box(std::span<const Vector3> points);

// Support point in direction d (d != 0): the first of the points that maximise p . d.
Vector3 support_point(const std::vector<Vector3>& points, const Vector3& d);
std::size_t support_index(const std::vector<Vector3>& points, const Vector3& d);

// Whether each directed edge and its reverse occur exactly once: no border, consistent orientation.
// O(n log d), d edges at a vertex.
bool is_closed(const TriangleMesh& mesh);

// Vertices of a hull as a structure of arrays, for a vectorised support function.
class SupportVertices {
 public:
  SupportVertices() = default;
  explicit SupportVertices(std::span<const Vector3> points);

  bool empty() const { return points_.rows() == 0; }
  // Index of the first point that maximises points[i] . d, bit-identical to a plain loop; 0 if d is
  // NaN. About 0.6 ns per point with SSE2.
  std::size_t support_index(const Vector3& d) const;

 private:
  static constexpr int kBlock = 32;  // maximum first by block, then the index within the best block
  Eigen::Array<double, Eigen::Dynamic, 3> points_;  // padded with the last point to whole blocks
};

}  // namespace twinarm
