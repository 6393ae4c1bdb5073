// A body in a cavity touches at its points of maximum distance from the centre or axis, each with
// the normal of the wall there: vertices (with the radius of a sphere or capsule), rims, tips of an
// ellipsoid. The distance is convex, so no point between two vertices is farther. All in the frame
// H of the cavity. Cost: 0.1-1 us.
//
// Rims, sections of a cylinder by the end planes of a tube, and the outline of an ellipsoid seen
// along a tube are rings x(t) = m + u cos t + w sin t; their squared distance from the axis is a0 +
// a1 cos t + b1 sin t + a2 cos 2t + b2 sin 2t. Farthest point of an ellipsoid from the centre of a
// sphere, y the centre in the ellipsoid's frame: x_i = -y_i s_i^2 / (mu - s_i^2) with sum x_i^2 /
// s_i^2 = 1. The largest root mu is the farthest point, the next one below the largest s_i^2 the
// opposite tip (D. Eberly, "Distance from a point to an ellipse, an ellipsoid, or a
// hyperellipsoid", 2013, for the nearest point).
#include "collision/narrow_phase/closed_forms.h"
#include "collision/narrow_phase/narrow_phase.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "collision/narrow_phase/manifold.h"

namespace twinarm {
namespace {

// Relative variation below which all points of a ring are equally far.
constexpr double kEquallyFar = 1e-6;

struct Ring {
  Vector3 m, u, w;
  Vector3 at(double t) const { return m + u * std::cos(t) + w * std::sin(t); }
};

class CavityContact {
 public:
  CavityContact(const PosedShape& hollow, const PosedShape& body, double margin,
                std::vector<ManifoldPoint>& out)
      : X_WH_(hollow.X_WG), X_HB_(hollow.X_WG.inverse() * body.X_WG), margin_(margin), out_(out) {
    if (const auto* tube = std::get_if<CylindricalCavity>(&hollow.solid.shape)) {
      radius_ = tube->radius;
      half_ = tube->length / 2;
      is_tube_ = true;
    } else {
      radius_ = std::get<SphericalCavity>(hollow.solid.shape).radius;
    }
  }

  void add_body(const PosedShape& body) {
    const Polytope& core = body.solid.core;
    if (const auto* cylinder = std::get_if<Cylinder>(&body.solid.shape)) return add(*cylinder);
    if (const auto* ellipsoid = std::get_if<Ellipsoid>(&body.solid.shape)) return add(*ellipsoid);
    const std::vector<Vector3>& vertices = core.hull.vertices;
    const int count = static_cast<int>(vertices.size());
    for (int i = 0; i < count; ++i) add_point(X_HB_ * vertices[i], core.radius, i);
    for (int e = 0; is_tube_ && e < static_cast<int>(core.edges.size()); ++e) {
      const Vector3 p = X_HB_ * vertices[core.edges[e].v0], q = X_HB_ * vertices[core.edges[e].v1];
      for (const int side : {0, 1}) {  // where the edge crosses an end plane
        const double z = side == 0 ? -half_ : half_;
        if ((p.z() < z) == (q.z() < z)) continue;
        Vector3 x = p + (q - p) * ((z - p.z()) / (q.z() - p.z()));
        x.z() = z;
        add_point(x, core.radius, count + 2 * e + side);
      }
    }
  }

 private:
  Vector3 across(const Vector3& x) const { return is_tube_ ? Vector3(x.x(), x.y(), 0) : x; }

  void add_point(const Vector3& x, double rounding_radius, int name) {
    if (is_tube_ && std::abs(x.z()) > half_) return;
    const Vector3 r = across(x);
    const double rho = r.norm(), depth = rho + rounding_radius - radius_;
    if (!(depth > -margin_)) return;
    const Vector3 out = rho > 0 ? Vector3(r / rho) : Vector3(Vector3::UnitX());
    const Vector3 p_B = x + rounding_radius * out;
    out_.push_back(
        {X_WH_ * Vector3(p_B - depth * out), X_WH_ * p_B, depth, name, -(X_WH_.R * out)});
  }

  // Adds the points of a ring farthest from the axis (or centre) that satisfy `is_there`.
  template <class IsThere>
  void add_ring(const Ring& ring, int name, IsThere is_there) {
    const Vector3 m = across(ring.m), u = across(ring.u), w = across(ring.w);
    const double a1 = 2 * m.dot(u), b1 = 2 * m.dot(w);
    const double a2 = 0.5 * (u.squaredNorm() - w.squaredNorm()), b2 = u.dot(w);
    const double variation = std::hypot(a1, b1) + std::hypot(a2, b2);
    const auto add_at = [&](double t, int part) {
      const Vector3 x = ring.at(t);
      if (is_there(x)) add_point(x, 0, name + part);
    };
    if (variation < kEquallyFar * (u.squaredNorm() + w.squaredNorm())) {
      // All points: four, fixed in the body.
      for (int k = 0; k < 4; ++k) add_at(0.5 * std::numbers::pi * k, k);
      return;
    }
    const auto value = [&](double t) {
      return a1 * std::cos(t) + b1 * std::sin(t) + a2 * std::cos(2 * t) + b2 * std::sin(2 * t);
    };
    constexpr int kSamples = 24;
    const double spacing = 2 * std::numbers::pi / kSamples;
    std::array<double, 2> peaks{};
    int found = 0;
    for (int k = 0; k < kSamples && found < 2; ++k) {
      double t = spacing * k;
      if (value(t) < value(t - spacing) || value(t) <= value(t + spacing)) continue;
      for (int i = 0; i < 30; ++i) {
        const double slope = -a1 * std::sin(t) + b1 * std::cos(t) - 2 * a2 * std::sin(2 * t) +
                             2 * b2 * std::cos(2 * t);
        const double curvature = -a1 * std::cos(t) - b1 * std::sin(t) - 4 * a2 * std::cos(2 * t) -
                                 4 * b2 * std::sin(2 * t);
        const double step =
            std::clamp(slope / std::max(std::abs(curvature), 1e-300), -spacing, spacing);
        t += step;
        if (std::abs(step) < 1e-15) break;
      }
      peaks[static_cast<std::size_t>(found++)] = t;
    }
    // Persistent order of two peaks, by their bearing from the middle of the ring: outer and inner,
    // or left and right.
    if (found == 2) {
      const auto bearing = [&](double t) {
        const Vector3 r = across(ring.at(t)) - m;
        const Vector3 left = normal_of(ring).cross(m);
        return std::atan2(r.dot(left), r.dot(m));
      };
      const double first = bearing(peaks[0]), second = bearing(peaks[1]);
      const bool is_in_and_out = std::abs(std::abs(first) - std::abs(second)) > 0.5;
      if (is_in_and_out ? std::abs(first) > std::abs(second) : first > second)
        std::swap(peaks[0], peaks[1]);
    }
    for (int i = 0; i < found; ++i) add_at(peaks[static_cast<std::size_t>(i)], i);
  }

  // Consistently oriented normal of the projected ring.
  Vector3 normal_of(const Ring& ring) const {
    return is_tube_ ? Vector3(Vector3::UnitZ()) : Vector3(ring.u.cross(ring.w));
  }

  void add(const Cylinder& c) {
    const Vector3 z = X_HB_.R.col(2), u = c.radius * X_HB_.R.col(0), w = c.radius * X_HB_.R.col(1);
    for (const int side : {0, 1}) {
      const Vector3 m = X_HB_ * Vector3(0, 0, side == 0 ? -c.length / 2 : c.length / 2);
      add_ring({m, u, w}, 8 * side, [](const Vector3&) { return true; });
    }
    if (!is_tube_ || std::abs(z.z()) < 1e-3) return;
    for (const int side : {0, 1}) {  // section by an end plane
      const double end = side == 0 ? -half_ : half_;
      const auto slid = [&](const Vector3& x, double to) {
        return Vector3(x + z * ((to - x.z()) / z.z()));
      };
      const auto is_on_body = [&](const Vector3& x) {
        return std::abs(z.dot(x - X_HB_.p)) < c.length / 2;
      };
      const Ring ring{slid(X_HB_.p, end), slid(u, 0), slid(w, 0)};
      add_ring(ring, 16 + 8 * side, is_on_body);
    }
  }

  void add(const Ellipsoid& e) {
    if (!is_tube_) return add_tips(e);
    // Normals perpendicular to the axis: n = (L^-T k, 0) with L L' the xy block of Q, |k| = 1.
    const Matrix3 Q = X_HB_.R * e.semi_axes.cwiseAbs2().asDiagonal() * X_HB_.R.transpose();
    const double l00 = std::sqrt(Q(0, 0)), l10 = Q(1, 0) / l00;
    const double l11 = std::sqrt(Q(1, 1) - l10 * l10);
    const Vector3 n_u(1 / l00, 0, 0), n_w(-l10 / (l00 * l11), 1 / l11, 0);
    add_ring({X_HB_.p, Q * n_u, Q * n_w}, 0, [](const Vector3&) { return true; });
  }

  void add_tips(const Ellipsoid& e) {
    const Vector3 squares = e.semi_axes.cwiseAbs2();
    int longest = 0;
    const double top = squares.maxCoeff(&longest);
    const double middle = squares.sum() - top - squares.minCoeff();
    Vector3 y = -(X_HB_.R.transpose() * X_HB_.p);  // centre of the cavity in the ellipsoid's frame
    if (std::abs(y[longest]) < 1e-12 * e.semi_axes[longest]) {
      y[longest] = 1e-12 * e.semi_axes[longest];  // equidistant tips: find both
    }
    // x with mu = top + shift.
    const auto point = [&](double shift) {
      return Vector3(-y.cwiseProduct(squares).array() / (shift + (top - squares.array())));
    };
    for (const double side : {1.0, -1.0}) {
      // Starting next to the pole: the function is decreasing and convex, so Newton never
      // overshoots.
      double shift = side * std::abs(y[longest]) * e.semi_axes[longest];
      bool found = false;
      for (int i = 0; i < 100 && !found; ++i) {
        const Vector3 x = point(shift);
        const double f = x.cwiseQuotient(e.semi_axes).squaredNorm() - 1;
        const double slope =
            -2 *
            (x.cwiseAbs2().array() / squares.array() / (shift + (top - squares.array()))).sum();
        const double step = -f / slope;
        if (side < 0 && (!(slope > 0) || shift + step <= middle - top)) break;  // no other tip
        shift += step;
        found = std::abs(step) <= 4e-16 * std::abs(shift);
      }
      if (found) add_point(X_HB_ * point(shift), 0, side > 0 ? 0 : 1);
    }
  }

  Pose X_WH_, X_HB_;
  double margin_, radius_ = 0, half_ = 0;
  bool is_tube_ = false;
  std::vector<ManifoldPoint>& out_;
};

}  // namespace

bool is_hollow(const Shape& shape) {
  return std::holds_alternative<SphericalCavity>(shape) ||
         std::holds_alternative<CylindricalCavity>(shape);
}

void cavity_contacts(const PosedShape& hollow, const PosedShape& body, double margin,
                     std::vector<ManifoldPoint>& out) {
  out.clear();
  CavityContact(hollow, body, margin, out).add_body(body);
  if (out.empty()) return;
  Vector3 mean = Vector3::Zero();
  for (const ManifoldPoint& point : out) mean += point.n_W;
  reduce_to_four(mean.norm() > 0.1 ? Vector3(mean.normalized()) : out[0].n_W, out);
}

double cavity_distance(const PosedShape& hollow, const PosedShape& body,
                       std::vector<ManifoldPoint>& points) {
  points.clear();
  CavityContact(hollow, body, 1e300, points).add_body(body);
  double distance = 1e300;
  for (const ManifoldPoint& point : points) distance = std::min(distance, -point.depth);
  return distance;
}

}  // namespace twinarm
