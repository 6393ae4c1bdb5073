// Closed forms: nearest points of two segments (C. Ericson, Real-Time Collision Detection, 2005,
// 5.1.9), and signed distance of a point from a box or cylinder. < 0.1 us.
#include "collision/narrow_phase/closed_forms.h"
#include "collision/narrow_phase/narrow_phase.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace twinarm {
namespace {

struct Segment {
  Vector3 start, along;
};

Segment core_of(const PosedShape& body) {
  const std::vector<Vector3>& ends = body.solid.core.hull.vertices;
  return {body.X_WG * ends.front(), body.X_WG.R * (ends.back() - ends.front())};
}

// Parameters of the nearest points; either segment may have no length.
std::pair<double, double> nearest_parameters(const Segment& a, const Segment& b) {
  const Vector3 r = a.start - b.start;
  const double aa = a.along.squaredNorm(), bb = b.along.squaredNorm();
  const double ab = a.along.dot(b.along), ar = a.along.dot(r), br = b.along.dot(r);
  if (aa == 0 && bb == 0) return {0, 0};
  if (aa == 0) return {0, std::clamp(br / bb, 0.0, 1.0)};
  if (bb == 0) return {std::clamp(-ar / aa, 0.0, 1.0), 0};
  const double sine2 = aa * bb - ab * ab;  // parallel: any s, corrected by the clamps
  double s = sine2 > 1e-12 * aa * bb ? std::clamp((ab * br - ar * bb) / sine2, 0.0, 1.0) : 0.0;
  const double t = std::clamp((ab * s + br) / bb, 0.0, 1.0);
  s = std::clamp((ab * t - ar) / aa, 0.0, 1.0);
  return {s, t};
}

NearestPair segments(const PosedShape& a, const PosedShape& b) {
  const Segment u = core_of(a), w = core_of(b);
  const auto [s, t] = nearest_parameters(u, w);
  const Vector3 p_a = u.start + s * u.along, p_b = w.start + t * w.along;
  const double distance = (p_b - p_a).norm();
  Vector3 n = p_b - p_a;
  if (distance < SignedPoint::kTouching) {  // crossing centre lines: normal to both
    n = u.along.cross(w.along);
    const double scale = u.along.norm() * w.along.norm();
    if (!(n.norm() > 1e-9 * scale)) {
      const Vector3& longer = u.along.squaredNorm() > w.along.squaredNorm() ? u.along : w.along;
      n = longer.squaredNorm() > 0 ? longer.unitOrthogonal() : Vector3(Vector3::UnitZ());
    }
  }
  n.normalize();
  const double r_a = a.solid.core.radius, r_b = b.solid.core.radius;
  const Vector3 middle = 0.5 * (p_a + r_a * n + p_b - r_b * n);
  return {{n, r_a + r_b - distance}, middle};
}

// B is the sphere. Empty if A has no closed-form distance from a point.
std::optional<NearestPair> sphere_at(const PosedShape& a, const PosedShape& b) {
  const Vector3 p = a.X_WG.inverse() * b.X_WG.p;
  SignedPoint at{};
  const bool is_known = std::visit(
      [&](const auto& shape) {
        if constexpr (requires { shape.nearest(p); }) at = shape.nearest(p);
        return requires {
          shape.nearest(p);
        };
      },
      a.solid.shape);
  if (!is_known) return std::nullopt;
  const Vector3 n = a.X_WG.R * at.normal;
  const double r = b.solid.core.radius;
  return NearestPair{{n, r - at.distance}, b.X_WG.p - n * (0.5 * (at.distance + r))};
}

bool is_round(const Shape& s) {
  return std::holds_alternative<Sphere>(s) || std::holds_alternative<Capsule>(s);
}

}  // namespace

std::optional<NearestPair> round_contact(const PosedShape& a, const PosedShape& b) {
  const Shape& sa = a.solid.shape;
  const Shape& sb = b.solid.shape;
  if (is_round(sa) && is_round(sb)) return segments(a, b);
  if (std::holds_alternative<Sphere>(sb)) return sphere_at(a, b);
  if (!std::holds_alternative<Sphere>(sa)) return std::nullopt;
  std::optional<NearestPair> pair = sphere_at(b, a);
  if (pair) pair->axis.n_W = -pair->axis.n_W;
  return pair;
}

}  // namespace twinarm
