// E13: semicircular arch of loose stones: no tension, no sliding, no crushing.
//
// A stone is a convex wedge between two radial joints with flat inner and outer faces. The arch is
// stable as long as some line of thrust lies within all joints. With H the thrust at the crown, m =
// H times its height, W and X the weight and the centroid of the stones from the crown to the joint
// at an angle phi from it, the thrust passes that joint at the radius
//   r = (m + W X) / (W sin phi + H cos phi).
// The minimum thickness for which some H, m keep r within every joint is 0.1073477445 of the mean
// radius for 20 stones, and 0.1074780381 for infinitely many with round faces.
// J. Heyman, "The safety of masonry arches", Int. J. Mech. Sci. 11, 1969; J. Ochsendorf, "The
// masonry arch on spreading supports", The Structural Engineer 84(2), 2006.
#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {
namespace {

using namespace contact_plots;

constexpr double kMeanRadius = 1, kDepth = 0.3, kDensity = 1000;
constexpr int kStones = 20;                                      // even: a joint at the crown
constexpr double kHalfAngle = std::numbers::pi / (2 * kStones);  // of a stone

struct Rim {
  double inner, outer;  // radii of the joints' ends [m]
};
Rim rim(double thickness) {
  return {kMeanRadius - thickness / 2, kMeanRadius + thickness / 2};
}
// Distance of a stone's centre of mass from the centre of the arch (trapezium).
double middle(const Rim& r) {
  const double height = r.outer - r.inner;
  return std::cos(kHalfAngle) *
         (r.inner + height * (r.inner + 2 * r.outer) / (3 * (r.inner + r.outer)));
}

// The stone's centre of mass at the origin, x along the radius, y across the arch.
Shape stone(const Rim& r) {
  std::vector<Vector3> corners;
  for (const double radius : {r.inner, r.outer})
    for (const double side : {1.0, -1.0})
      for (const double y : {0.5 * kDepth, -0.5 * kDepth})
        corners.emplace_back(radius * std::cos(kHalfAngle) - middle(r), y,
                             side * radius * std::sin(kHalfAngle));
  return convex_hull(corners);
}

// Largest displacement of a stone within a time, ground at z = 0; stops when it reaches `limit`
// [m].
double displacement(double thickness, double duration, double limit) {
  const Rim r = rim(thickness);
  const Shape shape = stone(r);
  ContactScene scene;
  scene.add_floor(surface(1));
  std::vector<Vector3> places;
  for (int i = 0; i < kStones; ++i) {
    const double angle = (2 * i + 1) * kHalfAngle;  // from the ground
    ContactScene::Body body{shape, surface(1), 1};
    body.mass = kDensity * kDepth * (r.outer - r.inner) * (r.outer + r.inner) *
                std::sin(kHalfAngle) * std::cos(kHalfAngle);
    body.R = rotation_about(Vector3::UnitY(), -angle);
    body.p = middle(r) * Vector3(std::cos(angle), 0, std::sin(angle));
    places.push_back(body.p);
    scene.add(body);
  }
  scene.start();
  double furthest = 0;
  while (scene.t() < duration && furthest < limit) {
    scene.step(kStep);
    for (int i = 0; i < kStones; ++i)
      furthest = std::max(furthest, (scene.p(i + 1) - places[static_cast<std::size_t>(i)]).norm());
  }
  return scene.ok() ? furthest : NAN;
}

// Range of m for which the line of thrust of a given H lies within all joints; negative: empty.
// Concave in H. In units of one stone's weight times 1 m.
double thrust_margin(const Rim& r, double H) {
  double low = r.inner * H, high = r.outer * H, W = 0, WX = 0;  // the joint at the crown
  for (int k = 1; k <= kStones / 2; ++k) {
    W += 1;
    WX += middle(r) * std::sin((2 * k - 1) * kHalfAngle);
    const double reach = W * std::sin(2 * k * kHalfAngle) + H * std::cos(2 * k * kHalfAngle);
    low = std::max(low, r.inner * reach - WX);
    high = std::min(high, r.outer * reach - WX);
  }
  return high - low;
}
bool is_stable(double thickness) {
  const Rim r = rim(thickness);
  double low = 0, high = kStones;
  for (int n = 0; n < 200; ++n) {
    const double third = (high - low) / 3;
    if (thrust_margin(r, low + third) < thrust_margin(r, high - third))
      low += third;
    else
      high -= third;
  }
  return thrust_margin(r, 0.5 * (low + high)) >= 0;
}

CaseResult stands(double scale) {  // thickness
  return {displacement(scale * 0.12, 2, 1)};
}
CaseResult falls(double scale) {  // thickness
  return {displacement(scale * 0.095, 2, 0.5) >= 0.5 ? 0.0 : 1.0};
}
CaseResult limit(double scale) {  // thickness
  const double reference = threshold(0.05, 0.2, 1e-12, is_stable);
  const double found = threshold(0.095, 0.12, 2e-5, [scale](double thickness) {
    return displacement(scale * thickness, 1, 1e-3) < 1e-3;
  });
  return {relative(found, reference)};
}

}  // namespace

CaseFamily arch_cases() {
  const Plot crown = Plot{{"z of the crown [m]"}, place<10, 2>}.with(&Plot::from_start, true);
  return {290,
          {contact_case<stands, -120>("E13-stands", 1e-6,
                                      crown.with(&Plot::exact, zero).without_convergence(kResting)),
           contact_case<falls, 150>("E13-falls", 0, crown.without_convergence(kCounted)),
           contact_case<limit, 1>("E13-limit", 3e-4, crown.searching("t/R"))}};
}

}  // namespace twinarm
