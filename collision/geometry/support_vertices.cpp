#include "collision/geometry/support_vertices.h"

#include <algorithm>
#include <limits>

namespace twinarm {

VertexTable::VertexTable(std::span<const Vector3> points) {
  const auto count = static_cast<Eigen::Index>(points.size());
  points_.resize((count + block - 1) / block * block, 3);
  for (Eigen::Index i = 0; i < points_.rows(); ++i)
    points_.row(i) = points[static_cast<std::size_t>(std::min(i, count - 1))].transpose();
}

std::size_t VertexTable::farthest(const Vector3& d) const {
  using Pair = Eigen::Array2d;  // a register
  const Pair dx = Pair::Constant(d.x()), dy = Pair::Constant(d.y()), dz = Pair::Constant(d.z());
  const double *x = points_.col(0).data(), *y = points_.col(1).data(), *z = points_.col(2).data();
  const auto pair = [](const double* at) { return Pair::Map(at); };
  Eigen::Index best = 0;
  double highest = -std::numeric_limits<double>::infinity();
  for (Eigen::Index first = 0; first < points_.rows(); first += block) {
    Pair even = Pair::Constant(highest), odd = even;
    for (Eigen::Index i = first; i < first + block; i += 4) {
      even = even.max(pair(x + i) * dx + pair(y + i) * dy + pair(z + i) * dz);
      odd = odd.max(pair(x + i + 2) * dx + pair(y + i + 2) * dy + pair(z + i + 2) * dz);
    }
    if (const double height = even.max(odd).maxCoeff(); height > highest) {
      highest = height;
      best = first;
    }
  }
  for (Eigen::Index i = best; i < best + block; ++i)
    if (x[i] * d.x() + y[i] * d.y() + z[i] * d.z() == highest) return static_cast<std::size_t>(i);
  return 0;
}

}  // namespace twinarm
