#include "collision/geometry/mesh.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace twinarm {

Aabb bounding_box(std::span<const Vector3> points) {
  Aabb box;
  for (const Vector3& p : points) box.extend(p);
  return box;
}

Vector3 support_point(const std::vector<Vector3>& points, const Vector3& d) {
  return points[support_index(points, d)];
}

std::size_t support_index(const std::vector<Vector3>& points, const Vector3& d) {
  std::size_t best = 0;
  double height = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const double h = points[i].dot(d); h > height) best = i, height = h;
  return best;
}

// The edges that start in vertex a end in ends[first[a]] to ends[first[a + 1]], in order.
bool is_closed(const TriangleMesh& mesh) {
  std::vector<std::ptrdiff_t> first(mesh.vertices.size() + 1, 0);
  for (const auto& t : mesh.triangles)
    for (const int a : t) ++first[a + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::ptrdiff_t> next = first;
  std::vector<int> ends(3 * mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles)
    ends[next[a]++] = b, ends[next[b]++] = c, ends[next[c]++] = a;
  const auto from = [&](int a) {
    return std::pair(ends.begin() + first[a], ends.begin() + next[a]);
  };
  const auto count = static_cast<int>(mesh.vertices.size());
  for (int a = 0; a < count; ++a) {
    const auto [begin, end] = from(a);
    std::sort(begin, end);
    if (std::adjacent_find(begin, end) != end) return false;
  }
  for (int a = 0; a < count; ++a)
    for (std::ptrdiff_t i = first[a]; i < next[a]; ++i) {
      const auto [begin, end] = from(ends[i]);
      if (ends[i] == a || !std::binary_search(begin, end, a)) return false;
    }
  return !ends.empty();
}

SupportVertices::SupportVertices(std::span<const Vector3> points) {
  const auto count = static_cast<Eigen::Index>(points.size());
  points_.resize((count + kBlock - 1) / kBlock * kBlock, 3);
  for (Eigen::Index i = 0; i < points_.rows(); ++i)
    points_.row(i) = points[static_cast<std::size_t>(std::min(i, count - 1))].transpose();
}

std::size_t SupportVertices::support_index(const Vector3& d) const {
  using Pair = Eigen::Array2d;  // one SSE register
  const Pair dx = Pair::Constant(d.x()), dy = Pair::Constant(d.y()), dz = Pair::Constant(d.z());
  const double *x = points_.col(0).data(), *y = points_.col(1).data(), *z = points_.col(2).data();
  const auto pair = [](const double* at) { return Pair::Map(at); };
  Eigen::Index best = 0;
  double highest = -std::numeric_limits<double>::infinity();
  for (Eigen::Index first = 0; first < points_.rows(); first += kBlock) {
    Pair even = Pair::Constant(highest), odd = even;
    for (Eigen::Index i = first; i < first + kBlock; i += 4) {
      even = even.max(pair(x + i) * dx + pair(y + i) * dy + pair(z + i) * dz);
      odd = odd.max(pair(x + i + 2) * dx + pair(y + i + 2) * dy + pair(z + i + 2) * dz);
    }
    if (const double height = even.max(odd).maxCoeff(); height > highest) {
      highest = height;
      best = first;
    }
  }
  for (Eigen::Index i = best; i < best + kBlock; ++i)
    if (x[i] * d.x() + y[i] * d.y() + z[i] * d.z() == highest) return static_cast<std::size_t>(i);
  return 0;
}

}  // namespace twinarm
