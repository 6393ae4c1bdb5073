// E14: self-locking of a wedge between two blocks: it stays if and only if mu >= tan(half angle).
//
// No gravity. The blocks are on a frictionless floor and are pressed together by 100 N; the wedge
// points down and can only move up.
#include "benchmarks/analytic/support/contact_scene.h"
#include "collision/shapes/shape.h"

namespace twinarm {
namespace {

using namespace contact_plots;

constexpr double kPress = 100;
constexpr double kHalfHeight = 0.1, kHalfWidth = 0.1, kHalfDepth = 0.1;  // at half the height [m]

// A prism along y: its faces `left` and `right` are lines x(z).
struct Line {
  double x, slope;  // at z = 0
  double at(double z) const { return x + slope * z; }
};
ConvexHull prism(const Line& left, const Line& right) {
  std::vector<Vector3> corners;
  for (const double z : {-kHalfHeight, kHalfHeight})
    for (const double y : {-kHalfDepth, kHalfDepth})
      for (const Line& line : {left, right}) corners.emplace_back(line.at(z), y, z);
  return convex_hull(corners);
}

// Body of 1 kg at the position of the hull.
ContactScene::Body body_of(ConvexHull hull, double mu) {
  const Vector3 middle = mass_properties(hull, 1000).com;
  for (Vector3& v : hull.vertices) v -= middle;
  ContactScene::Body body{convex_hull(hull.vertices), surface(mu), 1};
  body.p = middle;
  return body;
}

// Rise of the wedge in 0.5 s [m].
double rise(double half_angle, double mu) {
  const double slope = std::tan(half_angle);
  const Line left{-kHalfWidth, -slope}, right{kHalfWidth, slope};
  ContactScene scene(Vector3::Zero());
  scene.add_fixed(HalfSpace{Vector3::UnitZ(), -kHalfHeight}, surface(0));
  const int a = scene.add(body_of(prism({-3 * kHalfWidth, 0}, left), mu));
  const int wedge = scene.add(body_of(prism(left, right), mu));
  const int b = scene.start(body_of(prism(right, {3 * kHalfWidth, 0}), mu));
  scene.apply_force(a, {kPress, 0, 0});
  scene.apply_force(b, {-kPress, 0, 0});
  const double start = scene.p(wedge).z();
  scene.run(0.5, kStep);
  return scene.ok() ? scene.p(wedge).z() - start : NAN;
}

CaseResult self_locking(double scale) {  // mu
  return {max_over({5 * kDegree, 15 * kDegree, 30 * kDegree}, [scale](double angle) {
    const double limit = std::tan(angle);
    const double found = threshold(0.8 * limit, 1.2 * limit, 1e-4 * limit,
                                   [&](double mu) { return rise(angle, scale * mu) < 1e-4; });
    return relative(found, limit);
  })};
}

}  // namespace

CaseFamily wedge_cases() {
  const Plot height = Plot{{"z of the wedge [m]"}, place<2, 2>}.with(&Plot::from_start, true);
  return {300, {contact_case<self_locking, 2>("E14", 1e-3, height.searching("μ"))}};
}

}  // namespace twinarm
