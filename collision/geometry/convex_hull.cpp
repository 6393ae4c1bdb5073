// Convex hull by qhull: C. B. Barber, D. P. Dobkin, H. Huhdanpaa, "The Quickhull algorithm for
// convex hulls", ACM Trans. Math. Software 22 (1996). O(n log n). The only file that includes
// qhull.
//
// qhull merges facets whose centrums lie within a given distance of their neighbours' planes (its
// option C-d) and hands a merged facet out as an unordered set of vertices; they are put in order
// here. The planes are computed anew from the polygons, with the offset of the outermost input
// point: so no input point is outside any plane, whatever was merged.
#include "collision/geometry/convex_hull.h"

#include <libqhull_r/qhull_ra.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

[[noreturn]] void refuse(const std::string& rule) {
  throw InputError(
      {{"", 0, "convex hull", rule, "give at least 4 finite points that do not lie in one plane"}});
}

double extent_of(std::span<const Vector3> points) {
  Vector3 low = points[0], high = points[0];
  for (const Vector3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).maxCoeff();
}

// Area vector of a loop (Newell): its direction is the normal even where a corner is nearly flat.
Vector3 area_vector(const ConvexHull& hull, const std::vector<int>& loop) {
  const Vector3& base = hull.vertices[loop[0]];
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    sum += (hull.vertices[loop[i]] - base).cross(hull.vertices[loop[i + 1]] - base);
  }
  return sum;
}

// Puts the corners of a facet in order, by angle about their mean, seen against its normal.
void order_loop(const ConvexHull& hull, const Vector3& normal, std::vector<int>& loop) {
  Vector3 mean = Vector3::Zero();
  for (int v : loop) mean += hull.vertices[v] / static_cast<double>(loop.size());
  const Vector3 x = normal.unitOrthogonal(), y = normal.cross(x);
  std::vector<std::pair<double, int>> by_angle;
  for (int v : loop) {
    const Vector3 r = hull.vertices[v] - mean;
    by_angle.emplace_back(std::atan2(r.dot(y), r.dot(x)), v);
  }
  std::sort(by_angle.begin(), by_angle.end());
  for (std::size_t i = 0; i < loop.size(); ++i) loop[i] = by_angle[i].second;
  // Start at the smallest index: the same polygon is then always the same list.
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
}

using Loops = std::vector<std::pair<Vector3, std::vector<int>>>;  // normal, indices into the input

// A run of qhull, which frees what it holds. Its C interface: the C++ one does not compile as
// C++20. An error inside qhull comes back as an exit code (it jumps no farther than qh_new_qhull).
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
  std::FILE* silence;  // its messages are a page of geometry each
  qhT state;
};

Loops run_qhull(std::span<const Vector3> points, double tolerance) {
  std::vector<double> flat;
  flat.reserve(3 * points.size());
  for (const Vector3& p : points) flat.insert(flat.end(), {p.x(), p.y(), p.z()});
  QhullRun run;
  qhT* const qh = &run.state;  // the name that qhull's macros look for
  char digits[32];             // std::to_string() would write a comma where the locale has one
  const auto end =
      std::to_chars(digits, std::end(digits), tolerance * 1e9, std::chars_format::fixed, 6).ptr;
  std::string command = "qhull C-" + std::string(digits, end) + "e-9";
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

}  // namespace

std::string ConvexHull::fault() const {
  if (vertices.size() >= 4 && faces.size() >= 4 && normals.size() == faces.size()) return "";
  return "hull has " + std::to_string(vertices.size()) +
         " vertices and no complete faces, must come from convex_hull()";
}

void complete_faces(ConvexHull& hull) {
  hull.normals.clear();
  hull.offsets.clear();
  hull.triangles.clear();
  for (const std::vector<int>& loop : hull.faces) {
    const Vector3 n = area_vector(hull, loop).normalized();
    double offset = n.dot(hull.vertices[loop[0]]);
    for (const Vector3& v : hull.vertices) offset = std::max(offset, n.dot(v));
    hull.normals.push_back(n);
    hull.offsets.push_back(offset);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      hull.triangles.push_back({loop[0], loop[i], loop[i + 1]});
    }
  }
}

ConvexHull convex_hull(std::span<const Vector3> points, double flatness) {
  if (points.size() < 4) refuse("there are " + std::to_string(points.size()) + " points");
  for (const Vector3& p : points) {
    if (!p.allFinite()) refuse("a point is not finite");
  }
  const double extent = extent_of(points);
  if (!(extent > 0)) refuse("all points are the same");
  // qhull works on points about their own origin and of size one: its option text then has the same
  // number of digits for a screw and for a bridge.
  std::vector<Vector3> scaled(points.begin(), points.end());
  for (Vector3& p : scaled) p = (p - points[0]) / extent;
  Loops loops = run_qhull(scaled, flatness);

  // Each plane is held against each point.
  constexpr double kMostPlaneChecks = 4e9;
  if (static_cast<double>(loops.size()) * static_cast<double>(points.size()) > kMostPlaneChecks)
    throw InputError({{"", 0, "convex hull",
                       "there are " + std::to_string(points.size()) + " points, and " +
                           std::to_string(loops.size()) + " faces about them: too many",
                       "simplify the mesh: a body that is to be touched needs some hundred"}});

  // Number the corners in the order of the input.
  std::map<int, int> index;
  for (const auto& [normal, loop] : loops) {
    for (int v : loop) index[v] = 0;
  }
  ConvexHull hull;
  for (auto& [input, output] : index) {
    output = static_cast<int>(hull.vertices.size());
    hull.vertices.push_back(points[input]);
  }
  for (auto& [normal, loop] : loops) {
    for (int& v : loop) v = index[v];
    order_loop(hull, normal, loop);
    hull.faces.push_back(std::move(loop));
  }
  std::sort(hull.faces.begin(), hull.faces.end());
  complete_faces(hull);
  for (std::size_t f = 0; f < hull.faces.size(); ++f) {
    for (const Vector3& p : points) {
      hull.offsets[f] = std::max(hull.offsets[f], hull.normals[f].dot(p));
    }
  }
  return hull;
}

}  // namespace twinarm
