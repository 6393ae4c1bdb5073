// A semicircular arch of loose stones (E13): no tension, no sliding, and stone does not crush.
//
// The stones are true convex wedges: a slice between two radial joints, its inner and outer face
// flat. It stands as long as some line of thrust stays within all joints. With H the thrust at the
// crown, m = H times its height, W and X the weight and the middle of the stones from the crown to
// the joint at an angle phi from it, the thrust passes that joint at the radius
//   r = (m + W X) / (W sin phi + H cos phi).
// The least thickness for which some H, m keep r within every joint is what this very arch can
// have: 0.1073477445 of the mean radius for 20 stones. For infinitely many, with round faces, it is
// 0.1074780381.
// J. Heyman, "The safety of masonry arches", Int. J. Mech. Sci. 11, 1969; J. Ochsendorf, "The
// masonry arch on spreading supports", The Structural Engineer 84(2), 2006.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {
namespace {

using namespace contact_looks;

constexpr double kMeanRadius = 1, kDepth = 0.3, kDensity = 1000;
constexpr int kStones = 20;                                      // even: a joint at the crown
constexpr double kHalfAngle = std::numbers::pi / (2 * kStones);  // of a stone

struct Rim {
  double inner, outer;  // radii of the joints' ends [m]
};
Rim rim(double thickness) {
  return {kMeanRadius - thickness / 2, kMeanRadius + thickness / 2};
}
// Distance of a stone's centre of mass from the centre of the arch: that of a trapezium.
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

// How far a stone has gone from its place at most within a time, on ground at z = 0; no longer
// watched once that is `enough` [m].
double gone(double thickness, double duration, double enough) {
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
    body.R = turn_about(Vector3::UnitY(), -angle);
    body.p = middle(r) * Vector3(std::cos(angle), 0, std::sin(angle));
    places.push_back(body.p);
    scene.add(body);
  }
  scene.start();
  double furthest = 0;
  while (scene.t() < duration && furthest < enough) {
    scene.step(kStep);
    for (int i = 0; i < kStones; ++i)
      furthest = std::max(furthest, (scene.p(i + 1) - places[static_cast<std::size_t>(i)]).norm());
  }
  return scene.ok() ? furthest : NAN;
}

// Room that the best m leaves for the line of thrust of a given H; negative: none [N m]. Concave in
// H. In units of one stone's weight.
double room(const Rim& r, double H) {
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
bool holds(double thickness) {
  const Rim r = rim(thickness);
  double low = 0, high = kStones;
  for (int n = 0; n < 200; ++n) {
    const double third = (high - low) / 3;
    (room(r, low + third) < room(r, high - third) ? low : high) =
        room(r, low + third) < room(r, high - third) ? low + third : high - third;
  }
  return room(r, 0.5 * (low + high)) >= 0;
}

CaseResult stands(double off) {  // thickness
  return {gone(off * 0.12, 2, 1)};
}
CaseResult falls(double off) {  // thickness
  return {gone(off * 0.095, 2, 0.5) >= 0.5 ? 0.0 : 1.0};
}
CaseResult limit(double off) {  // thickness
  const double reference = threshold(0.05, 0.2, 1e-12, holds);
  const double found = threshold(
      0.095, 0.12, 2e-5, [off](double thickness) { return gone(off * thickness, 1, 1e-3) < 1e-3; });
  return {relative(found, reference)};
}

}  // namespace

CaseFamily arch_cases() {
  const ContactCasePlot crown{
      .readings = {"z of the crown [m]"}, .read = place<10, 2>, .from_start = true};
  ContactCasePlot still = crown;
  still.exact = zero;
  return {290,
          {contact_case<stands, -120>("E13-stands", 1e-6, without_steps(still, kResting)),
           contact_case<falls, 150>("E13-falls", 0, without_steps(crown, kCounted)),
           contact_case<limit, 1>("E13-limit", 3e-4, searched(crown, "t/R"))}};
}

}  // namespace twinarm
