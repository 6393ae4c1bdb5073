// Convex hull by qhull: C. B. Barber, D. P. Dobkin, H. Huhdanpaa, "The Quickhull algorithm for
// convex hulls", ACM Trans. Math. Software 22 (1996). O(n log n). The only file that includes
// qhull.
//
// qhull merges facets whose centrums lie within a given distance of their neighbours' planes
// (option C-d) and returns the vertices of a merged facet unordered; they are ordered here. The
// planes are recomputed from the polygons, with the offset of the outermost input point: no input
// point is outside a plane.

#include "collision/geometry/convex_hull.h"

#include <libqhull_r/qhull_ra.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>
#include <utility>

#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

[[noreturn]] void refuse(const std::string& problem) {
  throw InputError("convex hull", problem,
                   "give at least 4 finite points that do not lie in one plane", "hull.points");
}

// Area vector of a polygon (Newell): robust if consecutive edges are nearly parallel.
Vector3 area_vector(const ConvexHull& hull, const std::vector<int>& loop) {
  const Vector3& base = hull.vertices[loop[0]];
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    sum += (hull.vertices[loop[i]] - base).cross(hull.vertices[loop[i + 1]] - base);
  return sum;
}

// Grows with the angle of (x, y) from -2 to 2.
double pseudo_angle(double x, double y) {
  const double sum = std::abs(x) + std::abs(y), sine = sum > 0 ? y / sum : 0;
  return x >= 0 ? sine : std::copysign(2, y) - sine;
}

// Sorts the vertices of a facet counter-clockwise about the normal.
void order_loop(const ConvexHull& hull, const Vector3& normal, std::vector<int>& loop) {
  Vector3 mean = Vector3::Zero();
  for (int v : loop) mean += hull.vertices[v] / static_cast<double>(loop.size());
  const Vector3 x = normal.unitOrthogonal(), y = normal.cross(x);
  std::vector<std::pair<double, int>> by_angle;
  for (int v : loop) {
    const Vector3 r = hull.vertices[v] - mean;
    by_angle.emplace_back(pseudo_angle(r.dot(x), r.dot(y)), v);
  }
  std::sort(by_angle.begin(), by_angle.end());
  for (std::size_t i = 0; i < loop.size(); ++i) loop[i] = by_angle[i].second;
  // Start at the smallest index: a unique representation.
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
}

using Loops = std::vector<std::pair<Vector3, std::vector<int>>>;  // normal, indices into the input

// Owner of qhull's memory. The C interface is used: the C++ one does not compile as C++20.
// qh_new_qhull returns errors as an exit code.
struct QhullRun {
  QhullRun() : silence(std::fopen("/dev/null", "w")) { qh_zero(&state, silence); }
  QhullRun(const QhullRun&) = delete;
  QhullRun& operator=(const QhullRun&) = delete;
  ~QhullRun() {
    int kept = 0, total = 0;
    qh_freeqhull(&state, !qh_ALL);
    qh_memfreeshort(&state, &kept, &total);
    if (silence != nullptr) std::fclose(silence);
  }
  std::FILE* silence;  // qhull's messages are long
  qhT state;
};

Loops run_qhull(std::span<const Vector3> points, double tolerance) {
  std::vector<double> flat;
  flat.reserve(3 * points.size());
  for (const Vector3& p : points) flat.insert(flat.end(), {p.x(), p.y(), p.z()});
  QhullRun run;
  qhT* const qh = &run.state;  // qhull's macros use this name
  // Without a decimal point, which qhull reads by the locale. FQ: print the command instead of a
  // summary, which would check all lists.
  std::string command = "qhull C-" + std::to_string(std::llround(tolerance * 1e15)) + "e-15 FQ";
  constexpr std::size_t kManyPoints = 10000;
  // Depth first and without qhull's own outer planes: half the time. Facets may merge in another
  // way.
  if (points.size() > kManyPoints) command += " Q5 Q7";
  const int failed = qh_new_qhull(qh, 3, static_cast<int>(points.size()), flat.data(), False,
                                  command.data(), run.silence, run.silence);
  if (failed != 0) refuse("the points have no hull with a volume");
  Loops loops;
  facetT* facet;
  FORALLfacets {
    const Vector3 outward(facet->normal[0], facet->normal[1], facet->normal[2]);
    loops.emplace_back(outward, std::vector<int>{});
    vertexT *vertex, **vertexp;
    FOREACHvertex_(facet->vertices) {
      loops.back().second.push_back(qh_pointid(qh, vertex->point));
    }
  }
  return loops;
}

// Points in a balanced tree of boxes along their principal axes, flat where the points lie on a
// surface; node k is above nodes 2 k + 1 and 2 k + 2.
class PointTree {
 public:
  explicit PointTree(std::span<const Vector3> points) : points_(points.begin(), points.end()) {
    build(0, points_);
    const Aabb all = bounding_box(points);
    rounding_ = 1e-12 * (all.min().cwiseAbs() + all.max().cwiseAbs()).sum();
  }
  // The maximum of n . p over all points and `height`, bit-identical to a plain loop.
  double highest(const Vector3& n, double height) const {
    raise(0, points_, n, height);
    return height;
  }

 private:
  static constexpr std::size_t kLeafSize = 128;
  struct Node {
    Matrix3 axes;
    Aabb box;  // along the axes
  };

  void build(std::size_t node, std::span<Vector3> points) {
    if (nodes_.size() <= node) nodes_.resize(node + 1);
    const Vector3 centre = bounding_box(points).center();
    Matrix3 spread = Matrix3::Zero();
    for (const Vector3& p : points) spread += (p - centre) * (p - centre).transpose();
    const Matrix3 axes = Eigen::SelfAdjointEigenSolver<Matrix3>(spread).eigenvectors();
    nodes_[node].axes = axes;
    for (const Vector3& p : points) nodes_[node].box.extend(axes.transpose() * p);
    if (points.size() <= kLeafSize) return;
    const std::size_t half = points.size() / 2;
    const Vector3 along = axes.col(2);  // of the largest spread
    std::nth_element(
        points.begin(), points.begin() + static_cast<std::ptrdiff_t>(half), points.end(),
        [&](const Vector3& a, const Vector3& b) { return along.dot(a) < along.dot(b); });
    build(2 * node + 1, points.first(half));
    build(2 * node + 2, points.subspan(half));
  }
  void raise(std::size_t node, std::span<const Vector3> points, const Vector3& n,
             double& height) const {
    const Aabb& box = nodes_[node].box;
    const Vector3 along = nodes_[node].axes.transpose() * n;
    const double bound = along.dot(box.center()) + 0.5 * along.cwiseAbs().dot(box.sizes());
    if (bound + rounding_ < height) return;
    if (points.size() <= kLeafSize) {
      for (const Vector3& p : points) height = std::max(height, n.dot(p));
      return;
    }
    const std::size_t half = points.size() / 2;
    raise(2 * node + 1, points.first(half), n, height);
    raise(2 * node + 2, points.subspan(half), n, height);
  }

  std::vector<Vector3> points_;
  std::vector<Node> nodes_;
  double rounding_ = 0;  // of bounds [m]
};

// Fills `normals`, `offsets` and `triangles` from `vertices` and `faces`; no point is outside a
// plane.
void complete_faces(ConvexHull& hull, std::span<const Vector3> points) {
  const PointTree tree(points);
  for (const std::vector<int>& loop : hull.faces) {
    const Vector3 n = area_vector(hull, loop).normalized();
    hull.normals.push_back(n);
    hull.offsets.push_back(tree.highest(n, n.dot(hull.vertices[loop[0]])));
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      hull.triangles.push_back({loop[0], loop[i], loop[i + 1]});
  }
}

std::vector<Polytope::Slab> slabs_of(const ConvexHull& hull) {
  std::vector<Polytope::Slab> slabs;
  std::vector<bool> is_done(hull.normals.size(), false);
  const auto key = [](const Vector3& n, std::size_t face) {
    return std::tuple(n.x(), n.y(), n.z(), face);
  };
  std::vector<std::tuple<double, double, double, std::size_t>> faces;
  for (std::size_t f = 0; f < hull.normals.size(); ++f) faces.push_back(key(hull.normals[f], f));
  std::sort(faces.begin(), faces.end());
  for (std::size_t f = 0; f < hull.normals.size(); ++f) {
    if (is_done[f]) continue;
    const Vector3& n = hull.normals[f];
    slabs.push_back({n, 0, hull.offsets[f], false});
    const auto found = std::lower_bound(faces.begin(), faces.end(), key(-n, f + 1));
    const std::size_t g = found == faces.end() ? f : std::get<3>(*found);
    if (g == f || hull.normals[g] != -n) continue;
    slabs.back() = {n, -hull.offsets[g], hull.offsets[f], true};
    is_done[g] = true;
  }
  return slabs;
}

}  // namespace

std::string ConvexHull::fault() const {
  if (vertices.size() >= 4 && faces.size() >= 4 && normals.size() == faces.size()) return "";
  return "hull has " + std::to_string(vertices.size()) +
         " vertices and no complete faces, must come from convex_hull()";
}

ConvexHull convex_hull(std::span<const Vector3> points, double flatness) {
  if (points.size() < 4) refuse("there are " + std::to_string(points.size()) + " points");
  for (const Vector3& p : points)
    if (!p.allFinite()) refuse("a point is not finite");
  const double extent = bounding_box(points).sizes().maxCoeff();
  if (!(extent > 0)) refuse("all points are the same");
  // Points are scaled to size one: the tolerance in qhull's option text then has enough digits.
  std::vector<Vector3> scaled(points.begin(), points.end());
  for (Vector3& p : scaled) p = (p - points[0]) / extent;
  Loops loops = run_qhull(scaled, flatness);

  constexpr std::size_t kMaxFaces = 100000;
  if (loops.size() > kMaxFaces)
    throw InputError(
        "convex hull", "it has " + std::to_string(loops.size()) + " faces, must be at most 100,000",
        "simplify the mesh: some hundred faces are enough for collision", "hull.faces");

  // Vertices are numbered in the order of the input.
  std::vector<int> index(points.size(), -1);
  for (const auto& [normal, loop] : loops)
    for (int v : loop) index[v] = 0;
  ConvexHull hull;
  for (std::size_t input = 0; input < points.size(); ++input) {
    if (index[input] < 0) continue;
    index[input] = static_cast<int>(hull.vertices.size());
    hull.vertices.push_back(points[input]);
  }
  for (auto& [normal, loop] : loops) {
    for (int& v : loop) v = index[v];
    order_loop(hull, normal, loop);
    hull.faces.push_back(std::move(loop));
  }
  std::sort(hull.faces.begin(), hull.faces.end());
  complete_faces(hull, points);
  return hull;
}

// Each edge is traversed once by each of its two faces, in opposite directions.
Polytope ConvexHull::polytope() const {
  Polytope polytope;
  std::vector<std::tuple<int, int, bool, int>> edges;  // smaller vertex, larger, reversed, face
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::vector<int>& loop = faces[f];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto [a, b] = std::minmax(loop[i], loop[(i + 1) % loop.size()]);
      edges.emplace_back(a, b, a != loop[i], static_cast<int>(f));
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const auto& [a, b, is_reversed, face] = edges[i - 1];
    const auto& [c, d, is_opposite, other] = edges[i];
    if (a == c && b == d && !is_reversed && is_opposite)
      polytope.edges.push_back({a, b, face, other});
  }
  polytope.slabs = slabs_of(*this);
  polytope.hull = *this;
  constexpr std::size_t kSmallHull = 64;  // up to so many vertices a plain loop is as fast
  if (polytope.hull.vertices.size() > kSmallHull)
    polytope.table = SupportVertices(polytope.hull.vertices);
  return polytope;
}

int Polytope::support_index(const Vector3& d) const {
  return static_cast<int>(table.empty() ? twinarm::support_index(hull.vertices, d)
                                        : table.support_index(d));
}

ConvexHull box_hull(const Vector3& size) {
  ConvexHull hull;
  for (int i = 0; i < 8; ++i) {  // bit k of i: side along axis k
    const Vector3 sides(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    hull.vertices.push_back(0.5 * sides.cwiseProduct(size));
  }
  hull.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  complete_faces(hull, hull.vertices);
  return hull;
}

}  // namespace twinarm
