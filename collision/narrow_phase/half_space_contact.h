// A half-space against any other shape, in closed form.
#pragma once

#include <vector>

#include "collision/narrow_phase/clip.h"
#include "collision/narrow_phase/posed_shape.h"
#include "collision/shapes/aabb.h"

namespace twinarm {

// Outward normal of the half-space in W.
Vector3 outward_W(const Placed& half_space);

// Signed distance of `body` from the half-space: negative inside [m].
double half_space_distance(const Placed& half_space, const Placed& body);
// Of a box along the world's axes: no body within it is nearer.
double half_space_distance(const Placed& half_space, const Aabb& box);

// Up to four contacts with depth > -margin, for the normal out of the half-space. p_WA is on its
// surface, p_WB on the body.
void half_space_contacts(const Placed& half_space, const Placed& body, double margin,
                         std::vector<ManifoldPoint>& out);

}  // namespace twinarm
