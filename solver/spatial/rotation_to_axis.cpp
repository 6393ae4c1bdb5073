#include "solver/spatial/rotation_to_axis.h"

namespace twinarm {

// Rodrigues' formula about z x a, with 1 / (1 + a_z) written so that nothing cancels near -z.
Matrix3 turn_z_to(const Vector3& axis) {
  const Vector3 a = axis.normalized();
  const double x = a.x(), y = a.y(), z = a.z(), aside = x * x + y * y;
  if (aside == 0) return Vector3(1, z, z).asDiagonal();
  const double k = z > 0 ? 1 / (1 + z) : (1 - z) / aside;
  return (Matrix3() << 1 - k * x * x, -k * x * y, x, -k * x * y, 1 - k * y * y, y, -x, -y, z)
      .finished();
}

}  // namespace twinarm
