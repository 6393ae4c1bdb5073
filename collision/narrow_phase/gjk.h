// Nearest points of two convex cores that are apart: the distance algorithm of Gilbert, Johnson and
// Keerthi.
#pragma once

#include "collision/narrow_phase/posed_shape.h"

namespace twinarm {

constexpr double gjk_floor = 1e-9;  // nearer than this, nearest points give no direction [m]

struct CoreDistance {
  double distance = 0;             // between the cores; 0 where they overlap [m]
  Vector3 n_W = Vector3::Zero();   // unit, from A to B; zero where they overlap
  Vector3 p_WA = Vector3::Zero();  // nearest points
  Vector3 p_WB = Vector3::Zero();
};

// The core is the shape without the radius of spheres and capsules (a point, a segment). The search
// ends early where the cores are certainly more than `far` apart; the distance is then at least
// that, and no more than an upper bound. A pure function of the poses; does not allocate.
// Polytopes 0.2-1 us, curved shapes 1-4 us.
CoreDistance core_distance(const Placed& a, const Placed& b, double far = 1e300);

}  // namespace twinarm
