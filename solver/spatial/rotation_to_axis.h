// Shortest rotation that maps z to a direction. Replaces Eigen's FromTwoVectors, whose singular
// value decomposition adds 7 s to each translation unit.
#pragma once

#include "solver/spatial/pose.h"

namespace twinarm {

// R_AB with the normalized axis (in A, nonzero) as third column; exactly the identity for +z, a
// rotation by pi about x for -z. Rodrigues' formula about z x a, with 1 / (1 + a_z) rewritten to
// avoid cancellation near -z.
inline Matrix3 rotation_taking_z_to(const Vector3& axis) {
  const Vector3 a = axis.normalized();
  const double x = a.x(), y = a.y(), z = a.z(), aside = x * x + y * y;
  if (aside == 0) return Vector3(1, z, z).asDiagonal();
  const double k = z > 0 ? 1 / (1 + z) : (1 - z) / aside;
  return (Matrix3() << 1 - k * x * x, -k * x * y, x, -k * x * y, 1 - k * y * y, y, -x, -y, z)
      .finished();
}

}  // namespace twinarm
