// Polytopes: the corners of one body in the frame of the other, and one pass over them for each
// slab (a face with the face opposite to it, if it is parallel).  Box-box: 48 products, 0.1 us.
// Against a curved body: overlap(n), of a face only where it can be better than the best before.
#include "collision/flat_axis.h"

#include <algorithm>

#include "collision/direction.h"

namespace twinarm {

bool FlatAxis::best(const Placed& a, const Placed& b, double margin, Axis& axis) {
  if (a.solid.core.exists && b.solid.core.exists) return best_of_polytopes(a, b, margin, axis);
  return try_flats(a, b, a, 1, margin, axis) && try_flats(a, b, b, -1, margin, axis);
}

// Of `own`, which is a with sign 1 or b with -1.
bool FlatAxis::try_flats(const Placed& a, const Placed& b, const Placed& own, double sign,
                         double margin, Axis& axis) {
  const std::vector<Vector3>& flats = own.solid.patches.flats;
  const Placed& other = sign > 0 ? b : a;
  const std::size_t first = bound_flats(own, other, bounds_);
  for (std::size_t k = 0; k < flats.size(); ++k) {
    const std::size_t f = (first + k) % flats.size();
    if (bounds_[f] > axis.overlap) continue;
    const Vector3 out = own.X_WG.R * flats[f];
    if (bound_flat(own, f, out, other) > axis.overlap) continue;
    consider(a, b, sign * out, 0, axis);
    if (!(axis.overlap > -margin)) return false;
  }
  return true;
}

bool FlatAxis::try_slabs(const Polytope& own, const Polytope& other, const Pose& X_own_other,
                         double sign, double margin, const Matrix3& R_W_own, double radii,
                         Axis& axis) {
  vertices_.clear();
  for (const Vector3& v : other.hull.vertices) vertices_.push_back(X_own_other * v);
  for (const Polytope::Slab& slab : own.slabs) {
    double low = 1e300, high = -1e300;
    for (const Vector3& v : vertices_) {
      const double h = slab.normal.dot(v);
      low = std::min(low, h);
      high = std::max(high, h);
    }
    const double above = slab.high - low + radii, below = high - slab.low + radii;
    if (above < axis.overlap) axis = {sign * (R_W_own * slab.normal), above};
    if (slab.is_double && below < axis.overlap) axis = {-sign * (R_W_own * slab.normal), below};
    if (axis.overlap <= -margin) return false;
  }
  return true;
}

bool FlatAxis::best_of_polytopes(const Placed& a, const Placed& b, double margin, Axis& axis) {
  const Polytope &core_a = a.solid.core, &core_b = b.solid.core;
  const double radii = core_a.radius + core_b.radius;
  const Pose X_AB = a.X_WG.inverse() * b.X_WG;
  return try_slabs(core_a, core_b, X_AB, 1, margin, a.X_WG.R, radii, axis) &&
         try_slabs(core_b, core_a, X_AB.inverse(), -1, margin, b.X_WG.R, radii, axis);
}

}  // namespace twinarm
