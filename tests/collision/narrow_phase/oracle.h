// Independent answers to compare with, and the random bodies and poses to ask about.
//
// Signed distance of two convex bodies = signed distance of the origin from their Minkowski
// difference. For polytopes that is the hull of all differences of their vertices: here it is built
// with qhull and the origin is measured against every facet and triangle. Slow (0.1-5 ms), and it
// shares neither GJK nor separating axes with the code under test.
#pragma once

#include <random>
#include <vector>

#include "collision/geometry/mesh.h"
#include "collision/narrow_phase/gjk.h"
#include "collision/shapes/shape.h"
#include "solver/spatial/pose.h"

namespace twinarm::test {

struct Random {
  explicit Random(unsigned seed) : engine(seed) {}
  double uniform(double low, double high);
  Vector3 direction();
  Matrix3 rotation();
  std::mt19937 engine;
};

// Vertices (of the core, without the radius) of a shape; a cylinder as a prism with 2 x 48 corners.
std::vector<Vector3> core_vertices(const Shape& shape);
double core_radius(const Shape& shape);

double oracle_distance(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB);

// Least overlap(n) over 500 random directions, the best three of them refined by random steps that
// shrink. Of any two convex bodies; an upper bound of the depth.
double sampled_depth(Random& random, const PosedShape& a, const PosedShape& b);

// A pose of B in which B is pushed against A along a random direction until their supporting planes
// there are `gap` apart (negative: overlap).
Pose pushed_against(Random& random, const Shape& a, const Pose& X_WA, const Shape& b, double gap);

Pose random_pose(Random& random);

// By exact right angles.
Matrix3 quarter_turns(Random& random);

// 40 random points of an ellipsoid: a hull with many small faces.
ConvexHull random_hull(Random& random);

TriangleMesh box_mesh(const Vector3& size);
TriangleMesh moved(TriangleMesh mesh, const Pose& X, double scale = 1);

}  // namespace twinarm::test
