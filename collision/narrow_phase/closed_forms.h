// Pairs of shapes whose contacts have a closed form.
#pragma once

#include <optional>
#include <vector>

#include "collision/narrow_phase/clip.h"
#include "collision/narrow_phase/gjk.h"

namespace twinarm {

// ---- round_contact.cpp: spheres and capsules, and a sphere at a box or a cylinder ----

struct NearestPair {
  PenetrationDirection axis;      // exact normal from A to B; the overlap includes the radii
  Vector3 p_W = Vector3::Zero();  // midway between the surfaces
};

// Empty if this pair of shapes has no closed form.
std::optional<NearestPair> round_contact(const PosedShape& a, const PosedShape& b);

// ---- half_space_contact.cpp: a half-space against any other shape ----

// Outward normal of the half-space in W.
Vector3 outward_W(const PosedShape& half_space);

// Signed distance of `body` from the half-space, negative inside [m].
double half_space_distance(const PosedShape& half_space, const PosedShape& body);
// Of a bounding box: a lower bound.
double half_space_distance(const PosedShape& half_space, const Aabb& box);

// Up to four contacts with depth > -margin, with the outward normal of the half-space (A).
void half_space_contacts(const PosedShape& half_space, const PosedShape& body, double margin,
                         std::vector<ManifoldPoint>& out);

// ---- cavity_contact.cpp: the inside of a sphere or tube against a body in it ----

bool is_hollow(const Shape& shape);

// Up to four contacts with depth > -margin, each with its own inward normal, from the cavity (A) to
// the body (B). The body's origin is assumed to be inside; a tube has open ends without end faces.
void cavity_contacts(const PosedShape& hollow, const PosedShape& body, double margin,
                     std::vector<ManifoldPoint>& out);

// Signed distance of the body from the wall, negative with penetration; infinite for a body beyond
// the ends of a tube [m]. `scratch` avoids allocation.
double cavity_distance(const PosedShape& hollow, const PosedShape& body,
                       std::vector<ManifoldPoint>& scratch);

}  // namespace twinarm
