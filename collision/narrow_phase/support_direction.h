// What the searches for a contact direction share: judging a candidate, and placing the point.
#pragma once

#include <cstddef>
#include <vector>

#include "collision/narrow_phase/posed_shape.h"

namespace twinarm {

// Whether a distance that was found and the bound from its direction differ by more than rounding:
// for the true nearest points, distance = -overlap(n).
bool has_gap(double distance, double core_overlap);

// Takes the direction n_W (of any length) for `best` if its overlap is less by more than
// `handicap`.
void consider(const Placed& a, const Placed& b, Vector3 n_W, double handicap, Axis& best);

// Lower bounds of the overlaps along the flats of a hull (of other bodies: minus infinity), where
// overlap() asks all corners: of all flats from one point of the other body, a dot product each;
// returns the place of the least. And of flat `f` with normal n_W, from the other body's support.
std::size_t bound_flats(const Placed& body, const Placed& other, std::vector<double>& bounds);
double bound_flat(const Placed& body, std::size_t f, const Vector3& n_W, const Placed& other);

// p_W moved along n_W to the middle between the two supporting planes.
Vector3 midway(const Placed& a, const Placed& b, const Vector3& n_W, const Vector3& p_W);

Vector3 mean_of_supports(const Placed& a, const Placed& b, const Vector3& n_W);

}  // namespace twinarm
