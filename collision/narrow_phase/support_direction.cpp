// See support_direction.h. Each is one or two support calls: 10-50 ns, hulls by their number of
// vertices.
#include "collision/narrow_phase/support_direction.h"

#include <algorithm>
#include <limits>

namespace twinarm {
namespace {

double slack_of_flats(const Placed& body) {
  constexpr double scatter = 1e-5;  // of the extent: 100 times that of convex_hull()
  return body.solid.core.radius + scatter * body.solid.half.norm();
}

}  // namespace

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

// Along the normal n of a flat at n . x = offset, a point p of the other body is reached once the
// overlap is offset - n . p. The corners obey n . x <= offset but for what they scatter about it.
std::size_t bound_flats(const Placed& body, const Placed& other, std::vector<double>& bounds) {
  const std::vector<Vector3>& flats = body.solid.patches.flats;
  bounds.assign(flats.size(), -std::numeric_limits<double>::infinity());
  if (!body.solid.core.exists) return 0;
  const double slack = slack_of_flats(body);
  const Vector3 p = body.X_WG.inverse() * other.support_W(body.X_WG.p - other.X_WG.p);
  for (std::size_t f = 0; f < flats.size(); ++f)
    bounds[f] = body.solid.core.hull.offsets[f] - flats[f].dot(p) - slack;
  return static_cast<std::size_t>(std::min_element(bounds.begin(), bounds.end()) - bounds.begin());
}

double bound_flat(const Placed& body, std::size_t f, const Vector3& n_W, const Placed& other) {
  if (!body.solid.core.exists) return -std::numeric_limits<double>::infinity();
  const double from = (body.X_WG.p - other.support_W(-n_W)).dot(n_W);
  return from + body.solid.core.hull.offsets[f] - slack_of_flats(body);
}

Vector3 midway(const Placed& a, const Placed& b, const Vector3& n_W, const Vector3& p_W) {
  const double middle = 0.5 * n_W.dot(a.support_W(n_W) + b.support_W(-n_W));
  return p_W + n_W * (middle - n_W.dot(p_W));
}

Vector3 mean_of_supports(const Placed& a, const Placed& b, const Vector3& n_W) {
  return 0.5 * (a.support_W(n_W) + b.support_W(-n_W));
}

}  // namespace twinarm
