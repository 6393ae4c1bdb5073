// Support feature of a body (face, edge or vertex in a direction), and clipping of two features.
#pragma once

#include <vector>

#include "collision/narrow_phase/gjk.h"
#include "solver/spatial/pose.h"

namespace twinarm {

// A polygon (3 or more points), a segment (2) or a point (1) on the surface, in W [m].
struct Feature {
  std::vector<Vector3> points;  // a polygon is counter-clockwise seen from outside its body
  std::vector<int> labels;      // of the side from point i to i + 1: part of a contact's feature
  Vector3 normal_W = Vector3::Zero();  // of a polygon, outward
  double rounding_radius = 0;          // of a segment: radius of its cylinder or capsule [m]
  int id = 0;                          // index of the feature
  bool is_polygon() const { return points.size() >= 3; }
};

// Writes the support feature of `body` in direction n_W.
void support_feature(const PosedShape& body, const Vector3& n_W, Feature& feature);

struct ManifoldPoint {
  Vector3 p_WA, p_WB;             // on the surfaces, offset along the normal [m]
  double depth;                   // (p_WA - p_WB) . n [m]
  int feature;                    // persistent identity
  Vector3 n_W = Vector3::Zero();  // from A to B, if each point of the pair has its own
};

// From points of the pair (A, B) to those of (B, A).
void swap_roles(std::vector<ManifoldPoint>& points);

// Intersection of the two features projected along n_W (from A to B): vertices of the common
// polygon, ends of the common segment, or a point. May be empty.
void intersect_features(const Feature& a, const Feature& b, const Vector3& n_W, Feature& scratch,
                        Feature& clipped, std::vector<ManifoldPoint>& out);

// Hash of four numbers, positive, the same in every run.
int feature_name(int a, int b, int c, int d);

}  // namespace twinarm
