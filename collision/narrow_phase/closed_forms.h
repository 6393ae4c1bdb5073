// Pairs of shapes whose contacts have a closed form.
#pragma once

#include <optional>
#include <vector>

#include "collision/narrow_phase/clip.h"
#include "collision/narrow_phase/gjk.h"
#include "collision/shapes/aabb.h"

namespace twinarm {

// ---- round_contact.cpp: spheres and capsules, and a sphere at a box or a cylinder ----

struct NearestPair {
  PenetrationDirection axis;      // exact normal from A to B; the overlap includes the radii
  Vector3 p_W = Vector3::Zero();  // midway between the two surfaces
};

// Empty if there is no closed form for this pair of shapes.
std::optional<NearestPair> round_contact(const PosedShape& a, const PosedShape& b);

// ---- half_space_contact.cpp: a half-space against any other shape ----

// Outward normal of the half-space in W.
Vector3 outward_W(const PosedShape& half_space);

// Signed distance of `body` from the half-space: negative inside [m].
double half_space_distance(const PosedShape& half_space, const PosedShape& body);
// Of a box along the world's axes: no body within it is nearer.
double half_space_distance(const PosedShape& half_space, const Aabb& box);

// Up to four contacts with depth > -margin, for the normal out of the half-space. p_WA is on its
// surface, p_WB on the body.
void half_space_contacts(const PosedShape& half_space, const PosedShape& body, double margin,
                         std::vector<ManifoldPoint>& out);

// ---- cavity_contact.cpp: the inside of a sphere or tube against a body that moves within ----

bool is_hollow(const Shape& shape);

// Up to four contacts with depth > -margin, each with its own normal, from the hollow (A) to the
// body (B): inward. The body's origin is taken to be inside; a tube has no end caps, and its mouths
// touch nothing.
void hollow_contacts(const PosedShape& hollow, const PosedShape& body, double margin,
                     std::vector<ManifoldPoint>& out);

// Signed distance: how far the body is from the wall, negative where it has passed it; infinite for
// a body that is all beyond the mouths of a tube [m]. `scratch` keeps its memory from call to call.
double hollow_distance(const PosedShape& hollow, const PosedShape& body,
                       std::vector<ManifoldPoint>& scratch);

}  // namespace twinarm
