// What the searches for a contact direction share: judging a candidate, and placing the point.
#pragma once

#include "collision/solid.h"

namespace twinarm {

// Whether a distance that was found and the bound from its direction differ by more than rounding:
// for the true nearest points, distance = -overlap(n).
bool has_gap(double distance, double core_overlap);

// Takes the direction n_W (of any length) for `best` if its overlap is less by more than
// `handicap`.
void consider(const Placed& a, const Placed& b, Vector3 n_W, double handicap, Axis& best);

// p_W moved along n_W to the middle between the two supporting planes.
Vector3 midway(const Placed& a, const Placed& b, const Vector3& n_W, const Vector3& p_W);

Vector3 mean_of_supports(const Placed& a, const Placed& b, const Vector3& n_W);

}  // namespace twinarm
