// Overlays against the shapes and forces that they represent.
#include <doctest/doctest.h>

#include <algorithm>

#include "app/draw/overlays/overlays.h"
#include "app/draw/palette.h"
#include "app/inspect/inspection.h"
#include "tests/app/scene/model/helpers.h"

namespace twinarm {
namespace {

const char* const kLargeBall = R"(
[[body]]
name = "ball"
shape = { sphere = { radius = 0.4 } }
mass = 1
position = [0, 0, 0.4]
)";

SceneView stage_at(const SceneModel& scene, const Snapshot& moment) {
  SceneView stage = make_scene_view(scene);
  look_ahead(stage, moment);
  settle(stage);
  measure(stage, moment, Measured::of_picture);
  set_view(stage, {}, 1.5);
  return stage;
}

std::vector<Instance> instances_of(SceneView& stage, const Snapshot& moment, const char* overlay) {
  draw(stage, moment, {});
  const std::size_t bodies = stage.list.instances.size();
  draw(stage, moment, {overlay});
  return {stage.list.instances.begin() + static_cast<std::ptrdiff_t>(bodies),
          stage.list.instances.end()};
}

TEST_CASE("inertia: the inertia ellipsoid of a uniform ellipsoid is that ellipsoid") {
  const SceneModel scene = built(R"(
[[body]]
name = "stone"
shape = { ellipsoid = { semi_axes = [0.2, 0.3, 0.1] } }
mass = 1.7
position = [1, 2, 3]
orientation = [0.5, 0.5, 0.5, 0.5]
)");
  const Snapshot moment = snapshot_of(scene.model, scene.start);
  SceneView stage = stage_at(scene, moment);
  const auto found = instances_of(stage, moment, "inertia");
  REQUIRE(found.size() == 1);
  CHECK((found[0].X_WM.p - Vector3(1, 2, 3)).norm() < 1e-12);
  // x' A x = 1 of both, whatever the order of their axes.
  const auto quadric = [](const Pose& X, const Vector3& semi) {
    return Matrix3(X.R * semi.cwiseAbs2().cwiseInverse().asDiagonal() * X.R.transpose());
  };
  const Matrix3 expected = quadric(moment.k.X_WL[1], Vector3(0.2, 0.3, 0.1));
  CHECK(close(quadric(found[0].X_WM, found[0].scale), expected, 1e-9));
}

TEST_CASE("forces: the resultant of a pair acts at its centre of pressure") {
  const SceneModel scene = built(R"(
[[body]]
name = "floor"
fixed = true
shape = { halfspace = { normal = [0, 0, 1], offset = 0 } }
[[body]]
name = "box"
shape = { box = { size = [2, 2, 2] } }
mass = 1
position = [0, 0, 1]
)");
  Snapshot moment = snapshot_of(scene.model, scene.start);
  for (const double x : {-1.0, 1.0}) {
    ShownContact contact;
    contact.b = 1;
    contact.body_b = 1;
    contact.p_W = {x, 0, 0};
    contact.n_W = Vector3::UnitZ();
    contact.force_W = Vector3(0, 0, x < 0 ? 1.0 : 3.0);  // of 4 in all, at x = 0.5
    moment.contacts.push_back(contact);
  }
  SceneView stage = stage_at(scene, moment);
  const auto found = instances_of(stage, moment, "forces");
  REQUIRE(found.size() == 2);  // shaft and head
  CHECK((found[0].X_WM.p - Vector3(0.5, 0, 0)).norm() < 1e-12);
  REQUIRE(stage.list.labels.size() == 1);
  CHECK(stage.list.labels[0].text == "4 N");
  const double length = found[1].X_WM.p.z() + found[1].scale.z();  // tip of the head
  CHECK(length == doctest::Approx(4 * stage.scales.metres_per(4)));
  CHECK(length < 0.6 * stage.scales.length);
}

TEST_CASE("wrenches: weight and reaction of a hanging body, each where it acts, labelled once") {
  const SceneModel scene = built(kLargeBall);
  const Snapshot moment = snapshot_of(scene.model, scene.start);
  SceneView stage = stage_at(scene, moment);
  AppliedForce hold{.source = "wrench/0", .bodies = {}, .joints = {}};
  hold.bodies.push_back({1, {{0.5, 0, 0}, {0, 0, 9.81}}, {}});
  hold.point_W = Vector3(0, 0, 0.8);
  const Inspection inspection(scene.model, scene.start, {hold});
  stage.list.clear_frame();
  add_wrenches(stage, inspection);
  const auto& found = stage.list.instances;
  const auto starts_at = [&](const Vector3& p) {
    return std::ranges::any_of(
        found, [&](const Instance& part) { return (part.X_WM.p - p).norm() < 1e-9; });
  };
  CHECK(starts_at({0, 0, 0.4}));  // the weight, at the centre
  CHECK(starts_at({0, 0, 0.8}));
  std::vector<std::string> values;
  for (const Label& label : stage.list.labels) values.push_back(label.text);
  CHECK(values == std::vector<std::string>{"9.81 N", "9.81 N", "0.5 N m"});
  CHECK(stage.list.legend.size() == 2);
}

TEST_CASE("overlays: each one accepts a snapshot without contacts, couplings or motion") {
  const SceneModel scene = built(kLargeBall);
  const Snapshot moment = snapshot_of(scene.model, scene.start);
  SceneView stage = stage_at(scene, moment);
  for (const Overlay& overlay : all_overlays()) {
    CAPTURE(overlay.name);
    for (const Instance& instance : instances_of(stage, moment, overlay.name)) {
      CHECK(instance.X_WM.p.allFinite());
      CHECK(instance.scale.minCoeff() > 0);
    }
  }
}

TEST_CASE("device: the stylus is at its forward kinematics, beside the scene") {
  const SceneModel scene = built(kLargeBall);
  Snapshot moment = snapshot_of(scene.model, scene.start);
  SceneView none = stage_at(scene, moment);
  CHECK(instances_of(none, moment, "device").empty());
  moment.devices.push_back({});
  const auto ball_of_stylus = [&](const std::array<double, 6>& theta) {
    moment.devices[0].theta = theta;
    SceneView stage = stage_at(scene, moment);
    const auto found = instances_of(stage, moment, "device");
    REQUIRE(found.size() > 6);
    for (const Instance& part : found) CHECK(part.X_WM.p.x() < -0.4);
    for (const Instance& part : found)
      if (part.scale.isApproxToConstant(0.013)) return part.X_WM.p;
    FAIL("no sphere at the stylus joints");
    return Vector3(0, 0, 0);
  };
  // 45 degrees of the waist at L1 = 133.35 mm: to the left and away from the user at -y; 45 degrees
  // of the arm lift the point by both links.
  constexpr double L = 0.13335, half = 0.7853981633974483, s = 0.7071067811865476;
  const Vector3 rest = ball_of_stylus({});
  CHECK((ball_of_stylus({half, 0, 0, 1, 1, 1}) - rest - L * Vector3(-s, 1 - s, 0)).norm() < 1e-6);
  CHECK((ball_of_stylus({0, half, 0, 0, 0, 0}) - rest - L * Vector3(0, 1 - 2 * s, 1)).norm() <
        1e-6);
}

TEST_CASE("overlays: all misspelt names are reported") {
  const std::vector<Diagnostic> faults = faults_of([] { parse_overlays("forces,contcts,sprngs"); });
  REQUIRE(faults.size() == 2);
  CHECK(faults[0].fix.find("contacts") != std::string::npos);
  CHECK(parse_overlays("none").empty());
  CHECK(parse_overlays("all").size() == all_overlays().size() + 1);
  CHECK(parse_overlays("forces,contacts") == std::vector<std::string>{"forces", "contacts"});
}

TEST_CASE("units: three digits with a unit prefix") {
  for (const auto& [newtons, text] : {std::pair{0.0, "0 N"},
                                      {9.81, "9.81 N"},
                                      {98.1, "98.1 N"},
                                      {4567, "4.57 kN"},
                                      {999.9, "1 kN"}})
    CHECK(with_unit(newtons, "N") == text);
  CHECK(with_unit(-0.00123, "J") == "-1.23 mJ");
  CHECK(with_unit(0.0123, "N m") == "0.0123 N m");
}

// Lab of CIE 1976 under D65, of a linear sRGB colour.
Vector3 lab_of(const Vector3& rgb) {
  Matrix3 to_xyz;
  to_xyz << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
  const Vector3 xyz = (to_xyz * rgb).cwiseQuotient(Vector3(0.9505, 1, 1.089));
  const auto f = [](double t) {
    return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
  };
  const Vector3 v(f(xyz.x()), f(xyz.y()), f(xyz.z()));
  return {116 * v.y() - 16, 500 * (v.x() - v.y()), 200 * (v.y() - v.z())};
}

TEST_CASE("palette: body colours differ for protanopic and deuteranopic viewers") {
  // Machado, Oliveira, Fernandes (2009), full severity, on linear light.
  Matrix3 protan, deutan;
  protan << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116,
      1.051998;
  deutan << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940,
      0.968881;
  const auto linear = [](float c) {
    return c <= 0.04045f ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  for (const Matrix3& eye : {Matrix3(Matrix3::Identity()), protan, deutan})
    for (std::size_t i = 0; i < palette::kBodyColors; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        CAPTURE(i);
        CAPTURE(j);
        const auto seen = [&](const Color& c) {
          const Vector3 rgb(linear(c.r), linear(c.g), linear(c.b));
          return lab_of((eye * rgb).cwiseMax(0).cwiseMin(1));
        };
        CHECK((seen(palette::body(i)) - seen(palette::body(j))).norm() > 12);
      }
}

}  // namespace
}  // namespace twinarm
