// Curves below pictures, and the distance of interest.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "app/draw/curves.h"
#include "app/draw/scene_view.h"
#include "tests/app/scene/model/helpers.h"

namespace twinarm {
namespace {

const PlotCurve& curve_of(const Plot& plot, const std::string& name) {
  for (const PlotCurve& curve : plot.curves)
    if (curve.name == name) return curve;
  FAIL("no curve " << name);
  return plot.curves.front();
}

TEST_CASE("curves: the energy of a falling ball is constant, relative to the lowest potential") {
  const SceneModel scene = built(R"(
[[body]]
name = "ball"
shape = { sphere = { radius = 0.1 } }
mass = 2
position = [0, 0, 10]
)");
  CurveTrace trace(parse_curves("energy"));
  for (const double t : {0.0, 0.5, 1.0}) {
    State<double> x = scene.start;
    x.t = t;
    x.q[2] = 10 - 0.5 * 9.81 * t * t;
    std::fill(x.qd.begin(), x.qd.end(), 0.0);
    x.qd[5] = -9.81 * t;  // angular first
    trace.add(&scene, snapshot_of(scene.model, x));
  }
  const Plot plot = trace.plots().front();
  const double m_g_h = 2 * 9.81 * 0.5 * 9.81;
  CHECK(curve_of(plot, "potential").y[0] == doctest::Approx(m_g_h));
  CHECK(curve_of(plot, "potential").y[2] == doctest::Approx(0).epsilon(1e-9));
  for (const double sum : curve_of(plot, "sum").y) CHECK(sum == doctest::Approx(m_g_h));
}

TEST_CASE("curves: a curve that begins late starts with a gap") {
  const SceneModel scene = built(
      "[[body]]\nname = \"b\"\nmass = 1\n"
      "shape = { sphere = { radius = 1 } }\n");
  CurveTrace trace(parse_curves("forces"));
  Snapshot moment = snapshot_of(scene.model, scene.start);
  trace.add(&scene, moment);
  moment.x.t = 1;
  ShownCouplingForce force;
  force.name = "spring";
  force.force_W = Vector3(3, 0, 4);
  moment.coupling_forces.push_back(force);
  trace.add(&scene, moment);
  trace.add(&scene, moment);  // the same instant again: ignored
  const Plot plot = trace.plots().front();
  REQUIRE(plot.t.size() == 2);
  REQUIRE(plot.curves.size() == 1);
  CHECK(std::isnan(plot.curves[0].y[0]));
  CHECK(plot.curves[0].y[1] == 5);
}

TEST_CASE("curves: all misspelt names are reported") {
  CHECK(faults_of([] { parse_curves("energie,laag"); }).size() == 2);
  CHECK(parse_curves("none").empty());
  CHECK(parse_curves("tracking-error,energy").size() == 2);
}

// Instants of a point at x = f(i).
template <class F>
double interest(F&& f) {
  std::vector<Extent> instants;
  for (int i = 0; i < 200; ++i) {
    Extent extent;
    for (const double s : {-1.0, 1.0}) extent.add(Vector3(f(i) + s, s, s));
    instants.push_back(extent);
  }
  return max_distance_of_interest(instants);
}

TEST_CASE("framing: a thrown ball is framed, bodies of a diverged run are not") {
  CHECK(interest([](int i) { return 0.5 * i; }) > 100);            // thrown: 100 m in all
  CHECK(interest([](int i) { return 0.005 * i * i; }) > 200);      // falling: 200 m
  CHECK(interest([](int i) { return std::exp2(i - 170); }) < 10);  // 1e8 m in the end
  CHECK(interest([](int) { return 0.0; }) > 1);
}

}  // namespace
}  // namespace twinarm
