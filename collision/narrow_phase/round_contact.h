// Closed forms for spheres and capsules among themselves, and for a sphere at a box or a cylinder.
#pragma once

#include <optional>

#include "collision/narrow_phase/posed_shape.h"

namespace twinarm {

struct NearestPair {
  Axis axis;                      // exact normal from A to B; the overlap includes the radii
  Vector3 p_W = Vector3::Zero();  // midway between the two surfaces
};

// Empty if there is no closed form for this pair of shapes.
std::optional<NearestPair> round_contact(const Placed& a, const Placed& b);

}  // namespace twinarm
