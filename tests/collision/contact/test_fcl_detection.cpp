// Rigid contacts found by FCL's narrow phase, against closed forms.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/collision/contact/contact_scene.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

constexpr double g = 9.81, kStep = 1e-3;

// On a plate whose upper face is z = 0, with gravity as on a slope along x.
ContactScene on_plate(double slope, double friction) {
  ContactScene scene;
  scene.by_fcl = true;
  scene.set_gravity(Vector3(g * std::sin(slope), 0, -g * std::cos(slope)));
  scene.obstacle(Box{{20, 2, 0.2}}, rough_surface(friction, 1),
                 {Matrix3::Identity(), {0, 0, -0.1}});
  return scene;
}

CollisionWorld::FclUse use_of(const ContactScene& scene) {
  return scene.contacts().bodies().world().fcl_use();
}

Matrix3 turned(double angle, const Vector3& axis) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

}  // namespace

TEST_CASE("FCL: a stack of boxes, cylinders and hulls stands for 3 s") {
  const Shape box = Box{{0.3, 0.2, 0.1}}, drum = Cylinder{0.1, 0.1};
  const Shape cube = convex_hull(Box{{0.16, 0.16, 0.1}}.polytope().hull.vertices);
  ContactScene scene = on_plate(0, 0.5);
  std::vector<int> bodies;
  for (const Shape& shape : {box, box, drum, box, cube, drum})
    bodies.push_back(
        scene.body(shape, 2, rough_surface(0.5, 0),
                   {.p = {0, 0, 0.05 + 0.1 * static_cast<double>(bodies.size())},
                    .R = turned(0.3 * static_cast<double>(bodies.size()), Vector3::UnitZ())}));
  scene.begin();
  scene.run(kStep, 3000);
  double height = 0.05;
  for (const int body : bodies) {
    CHECK((scene.position(body) - Vector3(0, 0, height)).norm() < 1e-5);
    CHECK(scene.velocity(body).norm() < 1e-6);
    height += 0.1;
  }
  CHECK(use_of(scene).queries >= 6 * 3000);
  CHECK(use_of(scene).rejected == 0);
}

TEST_CASE("FCL: a cylinder and a capsule roll down with 2/3 and more of g sin(slope)") {
  const double slope = 0.1, t = 2;
  for (const Shape& shape : {Shape(Cylinder{0.1, 0.2}), Shape(Capsule{0.1, 0.2})}) {
    CAPTURE(shape_name(shape));
    ContactScene scene = on_plate(slope, 0.8);
    const Matrix3 lying = turned(std::numbers::pi / 2, Vector3::UnitX());
    const int body = scene.body(shape, 3, rough_surface(0.8, 0), {.p = {-5, 0, 0.1}, .R = lying});
    scene.begin();
    scene.run(kStep, static_cast<int>(t / kStep));
    const MassProperties solid = with_mass(mass_properties(shape, 1000), 3);
    const double a = g * std::sin(slope) / (1 + solid.inertia(2, 2) / (3 * 0.1 * 0.1));
    CHECK(scene.velocity(body).x() == doctest::Approx(a * t).epsilon(1e-6));
    CHECK(scene.position(body).x() + 5 == doctest::Approx(a * t * t / 2).epsilon(1e-3));
    CHECK(std::abs(scene.position(body).z() - 0.1) < 1e-5);
    CHECK(std::abs(scene.position(body).y()) < 1e-6);
  }
}

TEST_CASE("FCL: a box on a slope rests below the friction angle and slides above it") {
  const double slope = std::numbers::pi / 6, t = 1;
  for (const double friction : {0.6, 0.5}) {
    CAPTURE(friction);
    ContactScene scene = on_plate(slope, friction);
    const int body =
        scene.body(Box{{0.2, 0.2, 0.1}}, 2, rough_surface(friction, 0), {.p = {0, 0, 0.05}});
    scene.begin();
    scene.run(kStep, static_cast<int>(t / kStep));
    const double a = std::max(0.0, g * (std::sin(slope) - friction * std::cos(slope)));
    CHECK(scene.velocity(body).x() == doctest::Approx(a * t).epsilon(1e-6));
    CHECK(std::abs(scene.position(body).z() - 0.05) < 1e-5);
    CHECK(use_of(scene).rejected == 0);
  }
}

TEST_CASE("FCL: a ball bounces off a box with the restitution, to the height e^2 h") {
  ContactScene scene = on_plate(0, 0);
  const int ball = scene.body(Sphere{0.1}, 1, rough_surface(0, 0.8), {.p = {0, 0, 0.6}});
  scene.begin();
  double top = 0;
  bool has_bounced = false;
  for (int n = 0; n < 700; ++n) {
    scene.run(kStep, 1);
    has_bounced = has_bounced || scene.velocity(ball).z() > 1;
    if (has_bounced) top = std::max(top, scene.position(ball).z() - 0.1);
  }
  CHECK(top == doctest::Approx(0.5 * 0.8 * 0.8).epsilon(0.01));
}
