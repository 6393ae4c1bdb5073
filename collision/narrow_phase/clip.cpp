// Support features and their clipping (Sutherland and Hodgman, CACM 17(1), 1974).
//
// Both features are projected along the contact normal n, not along a face normal: the side planes
// of the clipping polygon contain n. So the vertex where two edges cross in the projection is the
// pair of nearest points of an edge-edge contact, and the result is symmetric in the bodies. Every
// vertex of the common area lies on two sides; their labels and those of the features identify it
// from step to step. Cost: vertices x sides; box face on box face 0.3 us.
#include "collision/narrow_phase/clip.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace twinarm {
namespace {

constexpr double kOnPlane = 1e-9;  // [m]

// A face within this angle (11 degrees) of the normal is the support feature; else an edge or
// cylinder side of smaller slope; else a vertex.
constexpr double kMinFaceCosine = 0.98;
constexpr double kMaxLineSlope = 0.2;
// Two segments at a larger angle touch at one point.
constexpr double kMaxParallelSine = 0.05;
// A cap with a smaller tilt is flat: its vertices are then fixed in the body.
constexpr double kFlatSine = 1e-6;
constexpr int kCapVertices = 8;
constexpr int kClipLabel = 1 << 12;

void segment(const PosedShape& body, double half, double radius, const Vector3& offset_W,
             Feature& f) {
  f.rounding_radius = radius;
  f.points = {body.X_WG * Vector3(0, 0, -half) + offset_W,
              body.X_WG * Vector3(0, 0, half) + offset_W};
  f.labels = {0, 1};
}

// Vertex 0 of a tilted cap is the support point of its rim: the true contact point, a smooth
// function of the pose. The ends of the side are the support points of the rims.
void cylinder_feature(const Cylinder& c, const PosedShape& body, const Vector3& n_W, Feature& f) {
  const Vector3 n = body.X_WG.R.transpose() * n_W;
  const double sine = std::hypot(n.x(), n.y()), side = n.z() < 0 ? -1 : 1;
  f.id = side > 0 ? 1 : 2;
  if (std::abs(n.z()) < kMaxLineSlope) {
    segment(body, c.length / 2, c.radius,
            body.X_WG.R * Vector3(n.x() * c.radius / sine, n.y() * c.radius / sine, 0), f);
    f.id = 3;
    return;
  }
  if (std::abs(n.z()) < kMinFaceCosine) {
    f.points = {body.support_W(n_W)};
    f.labels = {kCapVertices - 1};  // of the side before vertex 0: same feature as that vertex
    return;
  }
  const bool flat = sine < kFlatSine;
  const double x = flat ? c.radius : c.radius * n.x() / sine;
  const double y = flat ? 0 : c.radius * n.y() / sine;
  for (int k = 0; k < kCapVertices; ++k) {
    const double angle = side * 2 * std::numbers::pi * k / kCapVertices;
    const double cosine = std::cos(angle), sine_k = std::sin(angle);
    f.points.push_back(
        body.X_WG * Vector3(cosine * x - sine_k * y, sine_k * x + cosine * y, side * c.length / 2));
    f.labels.push_back(k);
  }
  f.normal_W = body.X_WG.R.col(2) * side;
}

// The face with the most vertices at the top, and of these the best aligned one.
int best_face(const PosedShape& body, const Vector3& n, double top, double tolerance) {
  const ConvexHull& hull = body.solid.core.hull;
  int best = -1;
  double best_score = 0;
  for (std::size_t f = 0; f < hull.faces.size(); ++f) {
    const double cosine = hull.normals[f].dot(n);
    if (cosine < kMinFaceCosine) continue;
    const auto at_top = std::count_if(hull.faces[f].begin(), hull.faces[f].end(), [&](int v) {
      return hull.vertices[v].dot(n) > top - tolerance;
    });
    if (at_top == 0) continue;
    const double score = 2.0 * static_cast<double>(std::min<std::ptrdiff_t>(at_top, 3)) + cosine;
    if (score > best_score) best_score = score, best = static_cast<int>(f);
  }
  return best;
}

// The edge at vertex `top` of smallest slope, or -1.
int best_edge(const Polytope& core, int top, const Vector3& n) {
  int best = -1;
  double min_slope = kMaxLineSlope;
  for (std::size_t e = 0; e < core.edges.size(); ++e) {
    if (core.edges[e].v0 != top && core.edges[e].v1 != top) continue;
    const Vector3 along =
        core.hull.vertices[core.edges[e].v1] - core.hull.vertices[core.edges[e].v0];
    const double slope = std::abs(along.dot(n)) / along.norm();
    if (slope < min_slope) min_slope = slope, best = static_cast<int>(e);
  }
  return best;
}

void polytope_feature(const PosedShape& body, const Vector3& n_W, Feature& f) {
  const Polytope& core = body.solid.core;
  const ConvexHull& hull = core.hull;
  const Vector3 n = body.X_WG.R.transpose() * n_W;
  const int top = core.support_index(n);
  const double tolerance = 1e-9 * (1e-3 + hull.vertices[top].norm());
  const int face = best_face(body, n, hull.vertices[top].dot(n), tolerance);
  const int count = static_cast<int>(hull.faces.size());
  if (face >= 0) {
    for (int v : hull.faces[face]) {
      f.points.push_back(body.X_WG * hull.vertices[v]);
      f.labels.push_back(static_cast<int>(f.labels.size()));
    }
    f.normal_W = body.X_WG.R * hull.normals[face];
    f.id = face;
    return;
  }
  const Vector3 rounding = core.radius * n_W;
  f.rounding_radius = core.radius;
  if (const int edge = best_edge(core, top, n); edge >= 0) {
    f.points = {body.X_WG * hull.vertices[core.edges[edge].v0] + rounding,
                body.X_WG * hull.vertices[core.edges[edge].v1] + rounding};
    f.labels = {0, 1};
    f.id = count + edge;
  } else {
    f.points = {body.X_WG * hull.vertices[top] + rounding};
    f.labels = {0};
    f.id = count + static_cast<int>(core.edges.size()) + top;
  }
}

// Clips against the plane side . x = offset; the new side gets the label of the plane. A vertex
// within rounding of the plane is kept: the crossing of two coincident edges is undetermined.
void clip(const Vector3& side, double offset, int label, const Feature& in, Feature& out) {
  out.points.clear();
  out.labels.clear();
  const double on = kOnPlane * side.norm();
  const std::size_t n = in.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3& p = in.points[i];
    const Vector3& q = in.points[(i + 1) % n];
    const double dp = side.dot(p) - offset, dq = side.dot(q) - offset;
    if (dp <= on) {
      out.points.push_back(p);
      out.labels.push_back(dp >= -on && dq > on ? label : in.labels[i]);
    }
    if ((dp < -on && dq > on) || (dp > on && dq < -on)) {
      out.points.push_back(p + (q - p) * (dp / (dp - dq)));
      out.labels.push_back(dp < 0 ? label : in.labels[i]);
    }
  }
}

// As clip(), for a segment.
void clip_segment(const Vector3& side, double offset, int label, Feature& f) {
  if (f.points.empty()) return;
  const double d0 = side.dot(f.points[0]) - offset, d1 = side.dot(f.points[1]) - offset;
  if (d0 > 0 && d1 > 0) {
    f.points.clear();
  } else if (d0 > 0 || d1 > 0) {
    const int outside = d0 > 0 ? 0 : 1;
    f.points[outside] = f.points[0] + (f.points[1] - f.points[0]) * (d0 / (d0 - d1));
    f.labels[outside] = label;
  }
}

void clip_by_polygon(const Feature& polygon, const Vector3& outward, Feature& scratch,
                     Feature& clipped) {
  const std::size_t n = polygon.points.size();
  for (std::size_t k = 0; k < n && !clipped.points.empty(); ++k) {
    const Vector3& v = polygon.points[k];
    const Vector3 side = (polygon.points[(k + 1) % n] - v).cross(outward);
    const int label = kClipLabel + polygon.labels[k];
    if (clipped.is_polygon()) {
      clip(side, side.dot(v), label, clipped, scratch);
      std::swap(clipped.points, scratch.points);
      std::swap(clipped.labels, scratch.labels);
      if (clipped.points.size() < 3) clipped.points.clear();
    } else if (clipped.points.size() == 2) {
      clip_segment(side, side.dot(v), label, clipped);
    } else if (side.dot(clipped.points[0] - v) > 1e-9 * side.norm()) {
      clipped.points.clear();
    }
  }
}

void intersect_segments(const Feature& a, const Feature& b, const Vector3& n, Feature& clipped,
                        std::vector<ManifoldPoint>& out) {
  const Vector3 u = a.points[1] - a.points[0], w = b.points[1] - b.points[0];
  const Vector3 cross = u.cross(w);
  if (cross.norm() > kMaxParallelSine * u.norm() * w.norm()) return;  // they cross: one point
  clip_segment(u, u.dot(a.points[1]), kClipLabel + 1, clipped);
  if (!clipped.points.empty()) clip_segment(-u, -u.dot(a.points[0]), kClipLabel, clipped);
  for (std::size_t i = 0; i < clipped.points.size(); ++i) {
    const Vector3& p_b = clipped.points[i];
    const Vector3 p_a = a.points[0] + u * (u.dot(p_b - a.points[0]) / u.squaredNorm());
    // Distance of two cylinder sides that are offset sideways, from their centre lines.
    const double along = (p_a - p_b).dot(n), offset = ((p_a - p_b) - n * along).norm();
    const double apart = a.rounding_radius + b.rounding_radius - along;
    const double depth = apart > 0 ? along + apart - std::hypot(apart, offset) : along;
    out.push_back({p_b + depth * n, p_b, depth, feature_name(a.id, b.id, clipped.labels[i], 7)});
  }
}

}  // namespace

int feature_name(int a, int b, int c, int d) {
  std::uint32_t hash = 2166136261u;  // FNV-1a over whole numbers
  for (int value : {a, b, c, d}) hash = (hash ^ static_cast<std::uint32_t>(value)) * 16777619u;
  return static_cast<int>(hash & 0x7fffffffu);
}

void swap_roles(std::vector<ManifoldPoint>& points) {
  for (ManifoldPoint& point : points) {
    std::swap(point.p_WA, point.p_WB);
    point.n_W = -point.n_W;
  }
}

void support_feature(const PosedShape& body, const Vector3& n_W, Feature& feature) {
  feature.points.clear();
  feature.labels.clear();
  feature.id = 0;
  feature.rounding_radius = 0;
  if (const auto* cylinder = std::get_if<Cylinder>(&body.solid.shape)) {
    cylinder_feature(*cylinder, body, n_W, feature);
  } else if (!body.solid.core.exists) {
    feature.points = {body.support_W(n_W)};
    feature.labels = {0};
  } else {
    polytope_feature(body, n_W, feature);
  }
}

void intersect_features(const Feature& a, const Feature& b, const Vector3& n_W, Feature& scratch,
                        Feature& clipped, std::vector<ManifoldPoint>& out) {
  const bool by_a = a.is_polygon();
  const Feature& polygon = by_a ? a : b;
  clipped.points = (by_a ? b : a).points;
  clipped.labels = (by_a ? b : a).labels;
  if (!polygon.is_polygon()) {
    if (a.points.size() == 2 && b.points.size() == 2) {
      clipped.points = b.points;
      clipped.labels = b.labels;
      intersect_segments(a, b, n_W, clipped, out);
    }
    return;
  }
  clip_by_polygon(polygon, by_a ? n_W : Vector3(-n_W), scratch, clipped);
  const double slope = polygon.normal_W.dot(n_W);
  const std::size_t n = clipped.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3& x = clipped.points[i];
    const Vector3 y = x + n_W * (polygon.normal_W.dot(polygon.points[0] - x) / slope);
    const int before = n > 2 ? clipped.labels[(i + n - 1) % n] : 0, after = clipped.labels[i];
    const int feature = feature_name(a.id, b.id, std::min(before, after), std::max(before, after));
    const Vector3& p_a = by_a ? y : x;
    const Vector3& p_b = by_a ? x : y;
    out.push_back({p_a, p_b, (p_a - p_b).dot(n_W), feature});
  }
}

}  // namespace twinarm
