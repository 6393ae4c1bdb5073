// Impacts within a step: contacts outside the initial margin, blocked rebounds, fast spin.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/collision/contact/contact_scene.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

constexpr double r = 0.05;

}  // namespace

// At rest the speculative margin is 0.5 mm. Before detection was repeated after an impact, the
// sphere ended 5 mm deep in the wall.
TEST_CASE(
    "a sphere at rest that is hit by another does not enter the wall behind it, near or far") {
  for (const double e : {0.0, 0.3, 1.0})
    for (const double gap : {1e-3, 4e-3, 9e-3, 17e-3}) {
      CAPTURE(e);
      CAPTURE(gap);
      ContactScene scene;
      scene.set_gravity(Vector3::Zero());
      const ContactSurface s = rough_surface(0.5, e);
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
      CHECK(scene.velocity(striker).x() > -19);  // of 20 m/s: the impact has occurred
    }
}

// A sphere bounces off two perpendicular walls: with friction mu each impulse p leaves m v = (1 -
// mu) p along either wall's normal, zero from mu = 1 on.
TEST_CASE("a sphere in a groove bounces as far as friction permits, and another independently") {
  for (const double mu : {0.3, 0.7, 1.2, 2.0}) {
    CAPTURE(mu);
    constexpr double e = 0.5;
    ContactScene scene;
    scene.set_gravity(Vector3::Zero());
    scene.obstacle(HalfSpace{Vector3::UnitX(), 0}, rough_surface(mu, 1));
    scene.obstacle(HalfSpace{Vector3::UnitZ(), 0}, rough_surface(mu, 1));
    const int ball = scene.body(Sphere{r}, 1, rough_surface(mu, e), {{r, 0, r}, {-1, 0, -1}});
    const int other = scene.body(Sphere{r}, 1, rough_surface(0, e), {{1, 0, r}, {0, 0, -1}});
    scene.begin();
    scene.run(1e-3, 1);
    const bool bounces = mu < 1;
    CHECK(scene.report().infeasible_impacts == (bounces ? 0 : 1));
    CHECK(scene.report().impact.residual <= 1e-8);
    CHECK(scene.report().impact_loss > 0);
    for (const int axis : {0, 2})
      CHECK(scene.velocity(ball)[axis] == doctest::Approx(bounces ? e : 0).epsilon(1e-7));
    CHECK(scene.velocity(other).z() == doctest::Approx(e).epsilon(1e-7));
  }
}

// With the gyroscopic moment of the step's start the nutation grew by h^2 W^2 / 2 in each step: a
// capsule accelerated from 170 to 4400 rad/s in half a second.
TEST_CASE("a fast spinning capsule nutates with the mean of its velocities") {
  constexpr double h = 1e-3;
  ContactScene scene;
  scene.set_gravity(Vector3::Zero());
  const Vector3 w(20, 0, 170);
  const int capsule = scene.body(Capsule{0.03, 0.12}, 1, rough_surface(0.5, 0), {{}, {}, w});
  const Simulation& simulation = scene.begin();
  const Inertia<double> body = simulation.mechanism().model().I[static_cast<std::size_t>(capsule)];
  const double energy = scene.energy();
  scene.run(h, 2000);
  CHECK(scene.energy() == doctest::Approx(energy).epsilon(1e-12));
  // d(w_x + i w_y)/dt = i W (w_x + i w_y), with the mean over a step.
  const double W = (body.I.zz - body.I.xx) / body.I.xx * w.z(), angle = 2 * std::atan(0.5 * h * W);
  const std::vector<double>& qd = simulation.state().qd;
  CHECK(qd[0] == doctest::Approx(w.x() * std::cos(2000 * angle)).scale(w.x()).epsilon(1e-9));
  CHECK(qd[1] == doctest::Approx(w.x() * std::sin(2000 * angle)).scale(w.x()).epsilon(1e-9));
  CHECK(qd[2] == doctest::Approx(w.z()).epsilon(1e-12));
}

TEST_CASE("a tumbling box keeps its energy exactly and its momentum with order 2 in the step") {
  const auto astray = [](double h) {
    ContactScene scene;
    scene.set_gravity(Vector3::Zero());
    const int box =
        scene.body(Box{{0.1, 0.2, 0.3}}, 1, rough_surface(0.5, 0), {{}, {}, {1, 30, -2}});
    const Simulation& simulation = scene.begin();
    const Inertia<double> body = simulation.mechanism().model().I[static_cast<std::size_t>(box)];
    const auto momentum = [&]() -> Vector3 {
      const std::vector<double>& qd = simulation.state().qd;
      const Vec3<double> L = body.I * Vec3<double>{qd[0], qd[1], qd[2]};
      return simulation.kinematics().R_WB[static_cast<std::size_t>(box)] * to_eigen(L);
    };
    const Vector3 L = momentum();
    const double energy = scene.energy();
    scene.run(h, static_cast<int>(std::lround(1 / h)));
    CHECK(scene.energy() == doctest::Approx(energy).epsilon(1e-12));
    return (momentum() - L).norm() / L.norm();
  };
  const double coarse = astray(1e-3), fine = astray(5e-4);
  CHECK(coarse < 1e-2);
  CHECK(coarse / fine == doctest::Approx(4).epsilon(0.05));
}

TEST_CASE("the energy of spinning bodies that fall onto a floor never increases") {
  for (const double e : {0.0, 0.5})
    for (const double spin : {50.0, 170.0, 400.0}) {
      CAPTURE(e);
      CAPTURE(spin);
      ContactScene scene;
      scene.set_gravity({0, 0, -9.81});
      scene.floor(rough_surface(0.5, 1));
      scene.body(Capsule{0.03, 0.12}, 1, rough_surface(0.5, e),
                 {{0, 0, 0.1}, {}, spin * Vector3(0.1, 0.2, 1)});
      scene.body(Box{{0.1, 0.06, 0.03}}, 1, rough_surface(0.5, e),
                 {{1, 0, 0.1}, {}, spin * Vector3(1, 0.2, 0.1)});
      scene.begin();
      double most = scene.energy();
      const double bound = most * (1 + 1e-9);
      for (int n = 0; n < 1000; ++n) {
        scene.run(1e-3, 1);
        most = std::max(most, scene.energy());
      }
      CHECK(most <= bound);
    }
}
