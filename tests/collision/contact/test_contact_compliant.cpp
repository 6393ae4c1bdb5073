// Compliant contact: Hunt-Crossley springs and bristle friction at any stiffness.
#include <doctest/doctest.h>

#include <cmath>
#include <utility>

#include "solver/support/diagnostics.h"
#include "tests/collision/contact/contact_scene.h"
#include "tests/collision/contact/hunt_crossley.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

ContactSurface soft(double stiffness, double friction) {
  ContactSurface s;
  s.stiffness = 2 * stiffness;  // two equal surfaces in series
  s.friction = friction;
  return s;
}

}  // namespace

TEST_CASE("a sphere at rest has the penetration depth m g / k at any stiffness") {
  for (const double k : {1e3, 1e5, 1e8, 1e11}) {
    CAPTURE(k);
    ContactScene scene(ContactResponse::compliant);
    scene.floor(soft(k, 0.5));
    const int ball = scene.body(Sphere{0.1}, 2, soft(k, 0.5), {{0, 0, 0.1}});
    scene.begin();
    int refused = 0;
    for (int n = 0; n < 8000; ++n) refused += !scene.simulation().step(1e-3).ok();
    CHECK(refused == 0);
    CHECK(0.1 - scene.position(ball).z() == doctest::Approx(2 * 9.81 / k).epsilon(1e-6));
  }
}

TEST_CASE("a block on a 30 degree slope sticks without creep, or slides with g (sin - mu cos)") {
  for (const double mu : {0.6, 0.5}) {
    CAPTURE(mu);
    ContactScene scene(ContactResponse::compliant);
    const double angle = std::acos(-1) / 6;
    scene.set_gravity({9.81 * std::sin(angle), 0, -9.81 * std::cos(angle)});
    scene.floor(soft(1e6, mu));
    const int block = scene.body(Box{{0.2, 0.2, 0.1}}, 2, soft(1e6, mu), {{0, 0, 0.05}});
    scene.begin();
    scene.run(1e-3, 2000);
    const double x = scene.position(block).x(), v = scene.velocity(block).x();
    scene.run(1e-3, 1000);
    if (mu > std::tan(angle))
      CHECK(std::abs(scene.position(block).x() - x) < 1e-9);
    else
      CHECK(scene.velocity(block).x() - v ==
            doctest::Approx(9.81 * (std::sin(angle) - mu * std::cos(angle))).epsilon(1e-3));
  }
}

TEST_CASE("two springs in series: the soft one dominates, two equal ones have half the stiffness") {
  const Compliance steel{1e12, 5}, rubber{1e4, 0.3};
  CHECK(in_series(steel, rubber).stiffness == doctest::Approx(1e4).epsilon(1e-7));
  CHECK(in_series(steel, rubber).dissipation == doctest::Approx(0.3).epsilon(1e-6));
  CHECK(in_series(rubber, steel).dissipation == in_series(steel, rubber).dissipation);
  CHECK(in_series(rubber, rubber).stiffness == doctest::Approx(5e3).epsilon(1e-15));
  CHECK(in_series(rubber, rubber).dissipation == doctest::Approx(0.3).epsilon(1e-15));
}

TEST_CASE(
    "a compliant impact converges to Hunt and Crossley's restitution with order 1 in the step") {
  for (const double cv : {0.1, 0.5, 1.0, 3.0}) {
    CAPTURE(cv);
    const double exact = hunt_crossley_restitution(cv);
    double error = 0;
    for (const double h : {2e-5, 1e-5, 5e-6}) {
      CAPTURE(h);
      ContactScene scene(ContactResponse::compliant);
      scene.set_gravity(Vector3::Zero());
      scene.floor(soft(1e5, 0));
      const int ball = scene.body(Sphere{0.1}, 1, soft(1e5, 0), {{0, 0, 0.1001}, {0, 0, -cv}});
      scene.begin();  // c = 1 s/m
      scene.run(h, static_cast<int>(0.05 / h));
      REQUIRE(scene.position(ball).z() > 0.1);
      const double error_before = error;
      error = exact - scene.velocity(ball).z() / cv;
      CHECK(std::abs(error) < 500 * h);
      if (error_before != 0) CHECK(error / error_before == doctest::Approx(0.5).epsilon(0.1));
    }
  }
}

TEST_CASE("Hunt and Crossley's restitution is 1 - (2/3) c v to first order, 0.594 at c v = 1") {
  for (const double cv : {1e-3, 1e-2, 1e-1}) {
    const double slope = (1 - hunt_crossley_restitution(cv)) / cv;
    CHECK(std::abs(slope - 2.0 / 3) < 0.5 * cv);
  }
  CHECK(hunt_crossley_restitution(0.1) == doctest::Approx(0.93748).epsilon(1e-5));
  CHECK(hunt_crossley_restitution(0.5) == doctest::Approx(0.74844).epsilon(1e-5));
  CHECK(hunt_crossley_restitution(1) == doctest::Approx(0.59362).epsilon(1e-5));
}

TEST_CASE("a surface with zero or undefined stiffness is rejected") {
  for (const auto& [stiffness, dissipation] :
       {std::pair{0.0, 1.0}, {-1.0, 1.0}, {INFINITY, 1.0}, {1e6, -1.0}, {1e6, NAN}}) {
    ContactScene scene(ContactResponse::compliant);
    ContactSurface surface;
    surface.stiffness = stiffness;
    surface.dissipation = dissipation;
    scene.floor(surface);
    CHECK_THROWS_AS(scene.begin(), InputError);
  }
}

TEST_CASE("the height of bounces never increases") {
  for (const double k : {1e4, 1e6}) {
    ContactScene scene(ContactResponse::compliant);
    scene.floor(soft(k, 0));
    const int ball = scene.body(Sphere{0.1}, 1, soft(k, 0), {{0, 0, 0.6}});
    scene.begin();
    double top = 0.6, height = 0, before = -1;
    for (int n = 0; n < 4000; ++n) {
      scene.run(1e-3, 1);
      const double v = scene.velocity(ball).z();
      if (before > 1e-6 && v <= 0) {  // at rest up to rounding
        CHECK(scene.position(ball).z() < top);
        top = scene.position(ball).z();
      }
      height = std::max(height, scene.position(ball).z()), before = v;
    }
    CHECK(height <= 0.6);
  }
}
