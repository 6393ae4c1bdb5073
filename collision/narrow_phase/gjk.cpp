// GJK: the nearest points of two convex bodies are the point v of the Minkowski difference D = A -
// B nearest to the origin. Each iteration adds the support point w of D towards the origin to at
// most three others, and keeps those that span the new nearest point. |v| is an upper bound of the
// distance, v . w / |v| a lower one: their difference ends the search.
// E. G. Gilbert, D. W. Johnson, S. S. Keerthi, IEEE J. Robotics and Automation 4(2), 1988. The
// nearest point of a simplex by signed areas and volumes after M. Montanari, N. Petrinic, E.
// Barbieri, ACM Trans. Graphics 36(3), 2017; here each side beyond which the origin lies is tried,
// so that rounding never loses the nearest one. All in the frame of A: no cancellation far from the
// world's origin.

#include "collision/narrow_phase/gjk.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

namespace twinarm {
namespace {

constexpr int kMaxGjkIterations = 200;        // polytopes take 3-10, ellipsoids up to some 50
constexpr double kCurvedTolerance = 1e-10;    // of the two bounds, for curved shapes [m]
constexpr double kPolytopeTolerance = 1e-15;  // for polytopes: finite termination [m]
constexpr double kFlat = 1e-13;               // sine below which a tetrahedron is degenerate

struct SimplexVertex {
  Vector3 w, p_A, p_B;  // w = p_A - p_B
};
using SimplexVertices = std::array<SimplexVertex, 4>;

// Vertex indices, their nearest point, and its barycentric coordinates.
struct Simplex {
  std::array<int, 4> vertex{};
  std::array<double, 4> weight{};
  int count = 0;
  Vector3 v = Vector3::Zero();
};

void take_nearer(const Simplex& other, Simplex& best) {
  if (best.count == 0 || other.v.squaredNorm() < best.v.squaredNorm()) best = other;
}

Simplex of_segment(const SimplexVertices& vertices, int i, int j) {
  const Vector3 &p = vertices[i].w, &q = vertices[j].w;
  const Vector3 along = q - p;
  const double square = along.squaredNorm(), t = -p.dot(along);
  if (!(t > 0)) return {{i}, {1}, 1, p};
  if (!(t < square)) return {{j}, {1}, 1, q};
  const double s = t / square;
  return {{i, j}, {1 - s, s}, 2, p + s * along};
}

// The origin's projection is inside, or beyond some of the three sides.
Simplex of_triangle(const SimplexVertices& vertices, int i, int j, int k) {
  const std::array<int, 3> number{i, j, k};
  const Vector3& p = vertices[i].w;
  const Vector3 n = (vertices[j].w - p).cross(vertices[k].w - p);
  const double square = n.squaredNorm();
  const Vector3 v = square > 0 ? Vector3(n * (n.dot(p) / square)) : Vector3(Vector3::Zero());
  Simplex inside{{i, j, k}, {}, 3, v}, best;
  for (int side = 0; side < 3; ++side) {  // opposite to vertex `side`
    const int from = number[(side + 1) % 3], to = number[(side + 2) % 3];
    const double area = n.dot((vertices[from].w - v).cross(vertices[to].w - v));
    inside.weight[side] = area / square;
    if (!(area > 0)) take_nearer(of_segment(vertices, from, to), best);
  }
  return best.count == 0 ? inside : best;
}

// The origin is inside (four vertices), or beyond some of the four faces.
Simplex of_tetrahedron(const SimplexVertices& vertices) {
  Simplex best;
  for (int top = 0; top < 4; ++top) {
    const int i = (top + 1) % 4, j = (top + 2) % 4, k = (top + 3) % 4;
    const Vector3& p = vertices[i].w;
    const Vector3 n = (vertices[j].w - p).cross(vertices[k].w - p);
    const Vector3 up = vertices[top].w - p;
    const double of_top = n.dot(up), of_origin = -n.dot(p);
    const bool is_flat = of_top * of_top <= kFlat * kFlat * n.squaredNorm() * up.squaredNorm();
    if (is_flat || !(of_top * of_origin > 0)) take_nearer(of_triangle(vertices, i, j, k), best);
  }
  return best.count == 0 ? Simplex{{0, 1, 2, 3}, {}, 4, Vector3::Zero()} : best;
}

Vector3 core_support(const PreparedShape& solid, const Vector3& direction) {
  if (!solid.core.exists || std::holds_alternative<Box>(solid.shape))
    return support(solid.shape, direction);
  return solid.core.hull.vertices[solid.core.support_index(direction)];
}

// Support point of D, in the frame of A.
SimplexVertex minkowski_support(const PosedShape& a, const PosedShape& b, const Pose& X_AB,
                                const Vector3& direction) {
  SimplexVertex vertex;
  vertex.p_A = core_support(a.solid, direction);
  vertex.p_B = X_AB * core_support(b.solid, X_AB.R.transpose() * -direction);
  vertex.w = vertex.p_A - vertex.p_B;
  return vertex;
}

// The simplex that spans the point of D nearest to the origin. Four vertices: D contains the
// origin.
Simplex nearest_point(const PosedShape& a, const PosedShape& b, const Pose& X_AB, double far,
                      SimplexVertices& vertices) {
  const bool are_polytopes = a.solid.core.exists && b.solid.core.exists;
  const double enough = are_polytopes ? kPolytopeTolerance : kCurvedTolerance;
  const Vector3 start = X_AB.p.squaredNorm() > 0 ? X_AB.p : Vector3(Vector3::UnitX());
  vertices[0] = minkowski_support(a, b, X_AB, start);
  Simplex simplex{{0}, {1}, 1, vertices[0].w};
  for (int iteration = 0; iteration < kMaxGjkIterations; ++iteration) {
    const double length = simplex.v.norm();
    if (!(length > kMinGjkDistance)) break;
    const SimplexVertex next = minkowski_support(a, b, X_AB, -simplex.v);
    const double bound = simplex.v.dot(next.w) / length;
    if (bound > far + kMinGjkDistance || !(length - bound > enough)) break;
    SimplexVertices kept;  // vertices that span v, and the new one
    for (int i = 0; i < simplex.count; ++i) kept[i] = vertices[simplex.vertex[i]];
    kept[simplex.count] = next;
    const Simplex better = simplex.count == 1   ? of_segment(kept, 0, 1)
                           : simplex.count == 2 ? of_triangle(kept, 0, 1, 2)
                                                : of_tetrahedron(kept);
    if (!(better.v.squaredNorm() < length * length)) break;  // no progress: rounding
    vertices = kept;
    simplex = better;
    if (simplex.count == 4) break;
  }
  return simplex;
}

double face_tolerance(const PosedShape& body) {
  constexpr double kScatter = 1e-5;  // relative to the extent: 100 times that of convex_hull()
  return body.solid.core.radius + kScatter * body.solid.half.norm();
}

}  // namespace

CoreDistance core_distance(const PosedShape& a, const PosedShape& b, double far) {
  const Pose X_AB = a.X_WG.inverse() * b.X_WG;
  SimplexVertices vertices;
  const Simplex simplex = nearest_point(a, b, X_AB, far, vertices);
  const double length = simplex.v.norm();
  if (!(length > kMinGjkDistance)) return {};
  CoreDistance answer{length, a.X_WG.R * (-simplex.v / length)};
  Vector3 p_A = Vector3::Zero(), p_B = Vector3::Zero();
  for (int i = 0; i < simplex.count; ++i) {
    p_A += simplex.weight[i] * vertices[simplex.vertex[i]].p_A;
    p_B += simplex.weight[i] * vertices[simplex.vertex[i]].p_B;
  }
  answer.p_WA = a.X_WG * p_A;
  answer.p_WB = a.X_WG * p_B;
  return answer;
}

bool has_duality_gap(double distance, double core_overlap) {
  return distance + core_overlap > 1e-8 + 1e-6 * distance;
}

void try_direction(const PosedShape& a, const PosedShape& b, Vector3 n_W, double min_gain,
                   PenetrationDirection& best) {
  const double length = n_W.norm();
  if (!(length > 1e-300)) return;
  n_W /= length;
  const double value = overlap(a, b, n_W);
  if (value < best.overlap - min_gain) best = {n_W, value};
}

// With the face n . x = offset, a point p of the other body gives overlap >= offset - n . p.
// Vertices satisfy n . x <= offset within the face tolerance.
std::size_t face_depth_lower_bounds(const PosedShape& body, const PosedShape& other,
                                    std::vector<double>& bounds) {
  const std::vector<Vector3>& face_normals = body.solid.boundary.face_normals;
  bounds.assign(face_normals.size(), -std::numeric_limits<double>::infinity());
  if (!body.solid.core.exists) return 0;
  const double tolerance = face_tolerance(body);
  const Vector3 p = body.X_WG.inverse() * other.support_W(body.X_WG.p - other.X_WG.p);
  for (std::size_t f = 0; f < face_normals.size(); ++f)
    bounds[f] = body.solid.core.hull.offsets[f] - face_normals[f].dot(p) - tolerance;
  return static_cast<std::size_t>(std::min_element(bounds.begin(), bounds.end()) - bounds.begin());
}

double face_depth_lower_bound(const PosedShape& body, std::size_t f, const Vector3& n_W,
                              const PosedShape& other) {
  if (!body.solid.core.exists) return -std::numeric_limits<double>::infinity();
  const double from = (body.X_WG.p - other.support_W(-n_W)).dot(n_W);
  return from + body.solid.core.hull.offsets[f] - face_tolerance(body);
}

Vector3 midway(const PosedShape& a, const PosedShape& b, const Vector3& n_W, const Vector3& p_W) {
  const double middle = 0.5 * n_W.dot(a.support_W(n_W) + b.support_W(-n_W));
  return p_W + n_W * (middle - n_W.dot(p_W));
}

Vector3 mean_of_supports(const PosedShape& a, const PosedShape& b, const Vector3& n_W) {
  return 0.5 * (a.support_W(n_W) + b.support_W(-n_W));
}

}  // namespace twinarm
