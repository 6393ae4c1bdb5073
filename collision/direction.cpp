// See direction.h. Each is one or two support calls: 10-50 ns, hulls by their number of vertices.
#include "collision/direction.h"

namespace twinarm {

bool has_gap(double distance, double core_overlap) {
  return distance + core_overlap > 1e-8 + 1e-6 * distance;
}

void consider(const Placed& a, const Placed& b, Vector3 n_W, double handicap, Axis& best) {
  const double length = n_W.norm();
  if (!(length > 1e-300)) return;
  n_W /= length;
  const double value = overlap(a, b, n_W);
  if (value < best.overlap - handicap) best = {n_W, value};
}

Vector3 midway(const Placed& a, const Placed& b, const Vector3& n_W, const Vector3& p_W) {
  const double middle = 0.5 * n_W.dot(a.support_W(n_W) + b.support_W(-n_W));
  return p_W + n_W * (middle - n_W.dot(p_W));
}

Vector3 mean_of_supports(const Placed& a, const Placed& b, const Vector3& n_W) {
  return 0.5 * (a.support_W(n_W) + b.support_W(-n_W));
}

}  // namespace twinarm
