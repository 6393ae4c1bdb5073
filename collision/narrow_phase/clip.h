// The support feature of a body (the part of its surface that faces a direction), and the
// intersection of two such features seen along that direction.
#pragma once

#include <vector>

#include "collision/narrow_phase/gjk.h"
#include "solver/spatial/pose.h"

namespace twinarm {

// A polygon (3 or more points), a segment (2) or a point (1) on the surface, in W [m].
struct Feature {
  std::vector<Vector3> points;  // a polygon is counter-clockwise seen from outside its body
  std::vector<int> labels;  // of the side from point i to i + 1: what a contact's name is made of
  Vector3 normal_W = Vector3::Zero();  // of a polygon, outward
  double roundness = 0;                // of a segment: radius of the side that it lies on [m]
  int id = 0;                          // which feature of the body this is
  bool is_polygon() const { return points.size() >= 3; }
};

// Writes the feature of `body` that is farthest along n_W.
void support_feature(const PosedShape& body, const Vector3& n_W, Feature& feature);

struct ManifoldPoint {
  Vector3 p_WA, p_WB;             // on either surface, one behind the other along the normal [m]
  double depth;                   // (p_WA - p_WB) . n [m]
  int feature;                    // its name
  Vector3 n_W = Vector3::Zero();  // from A to B, where each point of a pair has its own
};

// The points of the pair (B, A) from those of (A, B).
void swap_roles(std::vector<ManifoldPoint>& points);

// Where the two features lie behind each other along n_W (from A to B): the corners of the common
// area, the ends of the common segment, or the point. May be empty.
void intersect_features(const Feature& a, const Feature& b, const Vector3& n_W, Feature& scratch,
                        Feature& clipped, std::vector<ManifoldPoint>& out);

// A name from four numbers, positive, the same in every run.
int feature_name(int a, int b, int c, int d);

}  // namespace twinarm
