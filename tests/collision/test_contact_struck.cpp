// What is struck within a step: it may meet what was out of its reach, or be unable to bounce.
#include <doctest/doctest.h>

#include <algorithm>

#include "tests/collision/contact_scene.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

ContactSurface struck_surface(double friction, double restitution) {
  ContactSurface s;
  s.friction = friction;
  s.restitution = restitution;
  return s;
}

constexpr double r = 0.05;

}  // namespace

// At rest it looks half a millimetre ahead. It was found 5 mm deep in a wall before sources looked
// again after a blow.
TEST_CASE("a ball at rest that is struck does not enter the wall behind it, near or far") {
  for (const double e : {0.0, 0.3, 1.0})
    for (const double gap : {1e-3, 4e-3, 9e-3, 17e-3}) {
      CAPTURE(e);
      CAPTURE(gap);
      ContactScene scene;
      scene.set_gravity(Vector3::Zero());
      const ContactSurface s = struck_surface(0.5, e);
      scene.obstacle(HalfSpace{Vector3::UnitX(), 0}, s);
      const int ball = scene.body(Sphere{r}, 1, s, {{r + gap, 0, 0}});
      const int striker =
          scene.body(Sphere{r}, 5, s, {{3 * r + gap + 0.012, 0.01, 0}, {-20, 0, 0}});
      scene.begin();
      double deepest = 0;
      const double start = scene.energy();
      for (int n = 0; n < 20; ++n) {
        scene.run(1e-3, 1);
        deepest = std::max(deepest, r - scene.position(ball).x());
        CHECK(scene.energy() <= start * (1 + 1e-9));
      }
      CHECK(deepest < 1e-8);
      CHECK(scene.velocity(striker).x() > -19);  // of 20 m/s: it has struck
    }
}

// Two walls at right angles, from both of which a ball is to bounce: with friction mu each impulse
// p leaves m v = (1 - mu) p along either wall's normal, which is nothing to leave with from mu = 1
// on.
TEST_CASE("a ball in a groove bounces as far as friction lets it, and another by itself") {
  for (const double mu : {0.3, 0.7, 1.2, 2.0}) {
    CAPTURE(mu);
    constexpr double e = 0.5;
    ContactScene scene;
    scene.set_gravity(Vector3::Zero());
    scene.obstacle(HalfSpace{Vector3::UnitX(), 0}, struck_surface(mu, 1));
    scene.obstacle(HalfSpace{Vector3::UnitZ(), 0}, struck_surface(mu, 1));
    const int ball = scene.body(Sphere{r}, 1, struck_surface(mu, e), {{r, 0, r}, {-1, 0, -1}});
    const int other = scene.body(Sphere{r}, 1, struck_surface(0, e), {{1, 0, r}, {0, 0, -1}});
    scene.begin();
    scene.run(1e-3, 1);
    const bool bounces = mu < 1;
    CHECK(scene.report().wedged == (bounces ? 0 : 1));
    CHECK(scene.report().impact.residual <= 1e-8);
    CHECK(scene.report().impact_loss > 0);
    for (const int axis : {0, 2})
      CHECK(scene.velocity(ball)[axis] == doctest::Approx(bounces ? e : 0).epsilon(1e-7));
    CHECK(scene.velocity(other).z() == doctest::Approx(e).epsilon(1e-7));
  }
}
