// The shortest turn that takes z to a direction. Eigen's FromTwoVectors does it by a singular value
// decomposition, 7 s of every compiler run that names it.
#pragma once

#include "solver/spatial/pose.h"

namespace twinarm {

// R_AB with the axis (in A, of any length but 0) as its third column; exactly the identity for an
// axis along +z, half a turn about x for one along -z. By Rodrigues' formula about z x a, with
// 1 / (1 + a_z) written so that nothing cancels near -z.
inline Matrix3 rotation_taking_z_to(const Vector3& axis) {
  const Vector3 a = axis.normalized();
  const double x = a.x(), y = a.y(), z = a.z(), aside = x * x + y * y;
  if (aside == 0) return Vector3(1, z, z).asDiagonal();
  const double k = z > 0 ? 1 / (1 + z) : (1 - z) / aside;
  return (Matrix3() << 1 - k * x * x, -k * x * y, x, -k * x * y, 1 - k * y * y, y, -x, -y, z)
      .finished();
}

}  // namespace twinarm
