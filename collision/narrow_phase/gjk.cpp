// The nearest points of two convex bodies are the point v of D = A - B (all differences of points)
// that is nearest to the origin. Each round asks for the point w of D that lies farthest towards
// the origin, adds it to at most three others, and keeps those that carry the new nearest point.
//   |v| is never less than the distance, v . w / |v| never more: their difference ends the search.
// E. G. Gilbert, D. W. Johnson, S. S. Keerthi, IEEE J. Robotics and Automation 4(2), 1988. The
// nearest point of a simplex by signed areas and volumes, side by side, after M. Montanari, N.
// Petrinic, E. Barbieri, ACM Trans. Graphics 36(3), 2017; unlike there each side that the origin
// lies beyond is tried, so that rounding can choose the wrong order but never lose the nearest one.
// All in the frame of A, so that nothing loses digits far from the world's origin.

#include "collision/narrow_phase/gjk.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace twinarm {
namespace {

constexpr int max_rounds = 200;     // polytopes take 3-10, ellipsoids up to some 50
constexpr double resolved = 1e-10;  // of the two bounds, curved shapes: they come ever nearer [m]
constexpr double exact = 1e-15;     // the same of polytopes, which end at the very feature [m]
constexpr double kFlat = 1e-13;     // sine: such a tetrahedron has no side where the origin is

struct Corner {
  Vector3 w, p_A, p_B;  // w = p_A - p_B
};
using Corners = std::array<Corner, 4>;

// Corners by their number, the point that they carry, and its barycentric coordinates.
struct Simplex {
  std::array<int, 4> corner{};
  std::array<double, 4> weight{};
  int count = 0;
  Vector3 v = Vector3::Zero();
};

void take_nearer(const Simplex& other, Simplex& best) {
  if (best.count == 0 || other.v.squaredNorm() < best.v.squaredNorm()) best = other;
}

Simplex of_segment(const Corners& corners, int i, int j) {
  const Vector3 &p = corners[i].w, &q = corners[j].w;
  const Vector3 along = q - p;
  const double square = along.squaredNorm(), t = -p.dot(along);
  if (!(t > 0)) return {{i}, {1}, 1, p};
  if (!(t < square)) return {{j}, {1}, 1, q};
  const double s = t / square;
  return {{i, j}, {1 - s, s}, 2, p + s * along};
}

// The origin seen along the normal: inside, or beyond some of the three sides.
Simplex of_triangle(const Corners& corners, int i, int j, int k) {
  const std::array<int, 3> number{i, j, k};
  const Vector3& p = corners[i].w;
  const Vector3 n = (corners[j].w - p).cross(corners[k].w - p);
  const double square = n.squaredNorm();
  const Vector3 v = square > 0 ? Vector3(n * (n.dot(p) / square)) : Vector3(Vector3::Zero());
  Simplex inside{{i, j, k}, {}, 3, v}, best;
  for (int side = 0; side < 3; ++side) {  // opposite to corner `side`
    const int from = number[(side + 1) % 3], to = number[(side + 2) % 3];
    const double area = n.dot((corners[from].w - v).cross(corners[to].w - v));
    inside.weight[side] = area / square;
    if (!(area > 0)) take_nearer(of_segment(corners, from, to), best);
  }
  return best.count == 0 ? inside : best;
}

// Inside, which gives four corners, or beyond some of the four faces.
Simplex of_tetrahedron(const Corners& corners) {
  Simplex best;
  for (int top = 0; top < 4; ++top) {
    const int i = (top + 1) % 4, j = (top + 2) % 4, k = (top + 3) % 4;
    const Vector3& p = corners[i].w;
    const Vector3 n = (corners[j].w - p).cross(corners[k].w - p);
    const Vector3 up = corners[top].w - p;
    const double of_top = n.dot(up), of_origin = -n.dot(p);
    const bool is_flat = of_top * of_top <= kFlat * kFlat * n.squaredNorm() * up.squaredNorm();
    if (is_flat || !(of_top * of_origin > 0)) take_nearer(of_triangle(corners, i, j, k), best);
  }
  return best.count == 0 ? Simplex{{0, 1, 2, 3}, {}, 4, Vector3::Zero()} : best;
}

Vector3 core_support(const PreparedShape& solid, const Vector3& direction) {
  if (!solid.core.exists || std::holds_alternative<Box>(solid.shape)) {
    return support(solid.shape, direction);
  }
  return solid.core.hull.vertices[solid.core.farthest(direction)];
}

// The corner of D that lies farthest along `direction`, all in the frame of A.
Corner farthest(const PosedShape& a, const PosedShape& b, const Pose& X_AB,
                const Vector3& direction) {
  Corner corner;
  corner.p_A = core_support(a.solid, direction);
  corner.p_B = X_AB * core_support(b.solid, X_AB.R.transpose() * -direction);
  corner.w = corner.p_A - corner.p_B;
  return corner;
}

// The nearest point of D to the origin; the simplex carries it. All four corners: D holds the
// origin.
Simplex nearest_point(const PosedShape& a, const PosedShape& b, const Pose& X_AB, double far,
                      Corners& corners) {
  const bool are_polytopes = a.solid.core.exists && b.solid.core.exists;
  const double enough = are_polytopes ? exact : resolved;
  const Vector3 start = X_AB.p.squaredNorm() > 0 ? X_AB.p : Vector3(Vector3::UnitX());
  corners[0] = farthest(a, b, X_AB, start);
  Simplex simplex{{0}, {1}, 1, corners[0].w};
  for (int round = 0; round < max_rounds; ++round) {
    const double length = simplex.v.norm();
    if (!(length > gjk_floor)) break;
    const Corner next = farthest(a, b, X_AB, -simplex.v);
    const double bound = simplex.v.dot(next.w) / length;
    if (bound > far + gjk_floor || !(length - bound > enough)) break;
    Corners kept;  // what carries v now, and the next one
    for (int i = 0; i < simplex.count; ++i) kept[i] = corners[simplex.corner[i]];
    kept[simplex.count] = next;
    const Simplex better = simplex.count == 1   ? of_segment(kept, 0, 1)
                           : simplex.count == 2 ? of_triangle(kept, 0, 1, 2)
                                                : of_tetrahedron(kept);
    if (!(better.v.squaredNorm() < length * length)) break;  // rounding: this is it
    corners = kept;
    simplex = better;
    if (simplex.count == 4) break;
  }
  return simplex;
}

}  // namespace

CoreDistance core_distance(const PosedShape& a, const PosedShape& b, double far) {
  const Pose X_AB = a.X_WG.inverse() * b.X_WG;
  Corners corners;
  const Simplex simplex = nearest_point(a, b, X_AB, far, corners);
  const double length = simplex.v.norm();
  if (!(length > gjk_floor)) return {};
  CoreDistance answer{length, a.X_WG.R * (-simplex.v / length)};
  Vector3 p_A = Vector3::Zero(), p_B = Vector3::Zero();
  for (int i = 0; i < simplex.count; ++i) {
    p_A += simplex.weight[i] * corners[simplex.corner[i]].p_A;
    p_B += simplex.weight[i] * corners[simplex.corner[i]].p_B;
  }
  answer.p_WA = a.X_WG * p_A;
  answer.p_WB = a.X_WG * p_B;
  return answer;
}

// Each is one or two support calls: 10-50 ns, hulls by their number of
// vertices.
namespace {

double slack_of_flats(const PosedShape& body) {
  constexpr double scatter = 1e-5;  // of the extent: 100 times that of convex_hull()
  return body.solid.core.radius + scatter * body.solid.half.norm();
}

}  // namespace

bool has_gap(double distance, double core_overlap) {
  return distance + core_overlap > 1e-8 + 1e-6 * distance;
}

void consider(const PosedShape& a, const PosedShape& b, Vector3 n_W, double handicap,
              PenetrationDirection& best) {
  const double length = n_W.norm();
  if (!(length > 1e-300)) return;
  n_W /= length;
  const double value = overlap(a, b, n_W);
  if (value < best.overlap - handicap) best = {n_W, value};
}

// Along the normal n of a flat at n . x = offset, a point p of the other body is reached once the
// overlap is offset - n . p. The corners obey n . x <= offset but for what they scatter about it.
std::size_t face_depth_lower_bounds(const PosedShape& body, const PosedShape& other,
                                    std::vector<double>& bounds) {
  const std::vector<Vector3>& flats = body.solid.patches.flats;
  bounds.assign(flats.size(), -std::numeric_limits<double>::infinity());
  if (!body.solid.core.exists) return 0;
  const double slack = slack_of_flats(body);
  const Vector3 p = body.X_WG.inverse() * other.support_W(body.X_WG.p - other.X_WG.p);
  for (std::size_t f = 0; f < flats.size(); ++f)
    bounds[f] = body.solid.core.hull.offsets[f] - flats[f].dot(p) - slack;
  return static_cast<std::size_t>(std::min_element(bounds.begin(), bounds.end()) - bounds.begin());
}

double bound_flat(const PosedShape& body, std::size_t f, const Vector3& n_W,
                  const PosedShape& other) {
  if (!body.solid.core.exists) return -std::numeric_limits<double>::infinity();
  const double from = (body.X_WG.p - other.support_W(-n_W)).dot(n_W);
  return from + body.solid.core.hull.offsets[f] - slack_of_flats(body);
}

Vector3 midway(const PosedShape& a, const PosedShape& b, const Vector3& n_W, const Vector3& p_W) {
  const double middle = 0.5 * n_W.dot(a.support_W(n_W) + b.support_W(-n_W));
  return p_W + n_W * (middle - n_W.dot(p_W));
}

Vector3 mean_of_supports(const PosedShape& a, const PosedShape& b, const Vector3& n_W) {
  return 0.5 * (a.support_W(n_W) + b.support_W(-n_W));
}

}  // namespace twinarm
