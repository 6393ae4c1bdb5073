// A wedge that two blocks press between them (E14): it stays if and only if mu >= tan(half angle).
//
// No gravity. The blocks stand on a smooth floor and are pressed together by 100 N; the wedge,
// which points down, can only go up.
#include <algorithm>
#include <cmath>
#include <vector>

#include "benchmarks/analytic/support/contact_scene.h"
#include "collision/shapes/shape.h"

namespace twinarm {
namespace {

using namespace contact_looks;

constexpr double kPress = 100;
constexpr double kHalfHeight = 0.1, kHalfWidth = 0.1, kHalfDepth = 0.1;  // at half the height [m]

// A prism across y: x from `left` at the height z to `right`, each a line in z.
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

// Of 1 kg, the prism where it was made.
ContactScene::Body body_of(ConvexHull hull, double mu) {
  const Vector3 middle = mass_properties(hull, 1000).com;
  for (Vector3& v : hull.vertices) v -= middle;
  ContactScene::Body body{convex_hull(hull.vertices), surface(mu), 1};
  body.p = middle;
  return body;
}

// How far the wedge comes up in half a second [m].
double rise(double half_angle, double mu) {
  const double slope = std::tan(half_angle);
  const Line left{-kHalfWidth, -slope}, right{kHalfWidth, slope};
  ContactScene scene(Vector3::Zero());
  scene.add_fixed(HalfSpace{Vector3::UnitZ(), -kHalfHeight}, surface(0));
  const int a = scene.add(body_of(prism({-3 * kHalfWidth, 0}, left), mu));
  const int wedge = scene.add(body_of(prism(left, right), mu));
  const int b = scene.add(body_of(prism(right, {3 * kHalfWidth, 0}), mu));
  scene.start();
  scene.push(a, {kPress, 0, 0});
  scene.push(b, {-kPress, 0, 0});
  const double start = scene.p(wedge).z();
  scene.run(0.5, kStep);
  return scene.ok() ? scene.p(wedge).z() - start : NAN;
}

CaseResult self_locking(double off) {  // mu
  double error = 0;
  for (const double angle : {5 * kDegree, 15 * kDegree, 30 * kDegree}) {
    const double limit = std::tan(angle);
    const double found = threshold(0.8 * limit, 1.2 * limit, 1e-4 * limit,
                                   [&](double mu) { return rise(angle, off * mu) < 1e-4; });
    error = std::max(error, relative(found, limit));
  }
  return {error};
}

}  // namespace

CaseFamily wedge_cases() {
  const ContactCasePlot rises{
      .readings = {"z of the wedge [m]"}, .read = place<2, 2>, .from_start = true};
  return {300, {contact_case<self_locking, 2>("E14", 1e-3, searched(rises, "μ"))}};
}

}  // namespace twinarm
