// The inside of a sphere or of a tube against a body that moves within.
#pragma once

#include <vector>

#include "collision/narrow_phase/clip.h"
#include "collision/narrow_phase/posed_shape.h"

namespace twinarm {

bool is_hollow(const Shape& shape);

// Up to four contacts with depth > -margin, each with its own normal, from the hollow (A) to the
// body (B): inward. The body's origin is taken to be inside; a tube has no end caps, and its mouths
// touch nothing.
void hollow_contacts(const Placed& hollow, const Placed& body, double margin,
                     std::vector<ManifoldPoint>& out);

// Signed distance: how far the body is from the wall, negative where it has passed it; infinite for
// a body that is all beyond the mouths of a tube [m]. `scratch` keeps its memory from call to call.
double hollow_distance(const Placed& hollow, const Placed& body,
                       std::vector<ManifoldPoint>& scratch);

}  // namespace twinarm
