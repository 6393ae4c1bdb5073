// A triangle mesh: closed and outward-oriented where it bounds a solid.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "solver/spatial/pose.h"

namespace twinarm {

struct TriangleMesh {
  std::vector<Vector3> vertices;              // [m], in the frame of the link that owns it
  std::vector<std::array<int, 3>> triangles;  // counter-clockwise seen from outside
};

// The first of the points that lie farthest along d (any length but zero).
Vector3 max_along(const std::vector<Vector3>& points, const Vector3& d);

// Each directed edge occurs once and its reverse occurs once: the surface has no border, and all
// triangles agree on which side is outside. O(n log n).
bool is_closed(const TriangleMesh& mesh);

// Points by coordinate: which of them lies farthest along a direction is asked more often than
// anything else of a hull, and this way a vector register has coordinates of one kind.
class VertexTable {
 public:
  VertexTable() = default;
  explicit VertexTable(std::span<const Vector3> points);

  bool empty() const { return points_.rows() == 0; }
  // The number of the first point with the largest points[i] . d, to the bit; 0 where d is no
  // number. Some 0.6 ns a point with SSE2.
  std::size_t farthest(const Vector3& d) const;

 private:
  static constexpr int block = 32;  // points of which the highest is found before it is asked which
  Eigen::Array<double, Eigen::Dynamic, 3> points_;  // the last one repeated up to a whole block
};

}  // namespace twinarm
