// Independent distances, and random bodies and poses.
// Signed distance of two convex bodies = signed distance of the origin from their Minkowski
// difference. For polytopes: hull of all differences of vertices by qhull, compared with every
// facet and triangle. Slow (0.1-5 ms); shares neither GJK nor separating axes with the code under
// test.
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

// Vertices (of the core, without the radius) of a shape; a cylinder as a prism with 2 x 48
// vertices.
std::vector<Vector3> core_vertices(const Shape& shape);
double core_radius(const Shape& shape);

double oracle_distance(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB);

// Minimum overlap(n) over 500 random directions, the best three refined by shrinking random steps.
// An upper bound of the depth of any two convex bodies.
double sampled_depth(Random& random, const PosedShape& a, const PosedShape& b);

// A pose of B at A in a random direction, with a distance `gap` of the support planes (negative:
// overlap).
Pose pushed_against(Random& random, const Shape& a, const Pose& X_WA, const Shape& b, double gap);

Pose random_pose(Random& random);

// Rotated by exact right angles.
Matrix3 quarter_turns(Random& random);

// 40 random points of an ellipsoid: a hull with many small faces.
ConvexHull random_hull(Random& random);

TriangleMesh box_mesh(const Vector3& size);
TriangleMesh moved(TriangleMesh mesh, const Pose& X, double scale = 1);

}  // namespace twinarm::test
