// Event-driven steps while contacts stick or roll: no located events, no dependence on the friction
// coefficient (collision/contact/contact_active_set.h).
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "tests/collision/contact/contact_scene.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

using std::complex;

struct Work {
  int events = 0, problems = 0;
};

Work run_located(Simulation& simulation, double duration, double h) {
  Work all;
  for (long n = 0; n < std::lround(duration / h); ++n) {
    const StepReport report = simulation.step(h);
    CHECK(report.ok());
    all.events += report.events, all.problems += report.iterations;
  }
  return all;
}

// A solid sphere that rolls on a table that turns at `turn` and is tilted, so that gravity is g
// along it: dv/dt = (2/7) turn e_z x v + (5/7) g, with vectors as complex numbers.
complex<double> rolled(complex<double> r0, complex<double> v0, complex<double> g, double turn,
                       double t) {
  const complex<double> iw(0, turn * 2 / 7), drift = -g * (5 / 7.0) / iw;
  return r0 + (v0 - drift) * (std::exp(iw * t) - 1.0) / iw + drift * t;
}

// A thin coin rolls on its edge, at one degree from the vertical.
struct RollingCoin {
  explicit RollingCoin(double friction) {
    constexpr double radius = 0.01, tilt = M_PI / 180, spin = 10 * M_PI;
    scene.set_gravity({0, 0, -9.81});
    scene.floor(rough_surface(friction, 0));
    const Matrix3 R = Eigen::AngleAxisd(M_PI / 2 + tilt, Vector3::UnitY()).toRotationMatrix();
    coin = scene.body(Cylinder{radius, 1e-7}, 1, rough_surface(friction, 0),
                      {.p = {radius * std::sin(tilt), 0, radius * std::cos(tilt)},
                       .v = {0, radius * std::sin(tilt) * spin, 0},
                       .w = {0, 0, spin},
                       .R = R});
    scene.begin().locate_events();
    work = run_located(scene.simulation(), 0.4, 0.01);
  }
  ContactScene scene;
  int coin;
  Work work;
};

}  // namespace

TEST_CASE("event steps: a sphere that rolls on a tilted turntable is located no event") {
  constexpr double turn = 4, radius = 0.05, tilt = 5 * M_PI / 180, duration = 3.3;
  for (const double friction : {0.3, 1.0, 100.0}) {
    CAPTURE(friction);
    ContactScene scene;
    scene.set_gravity(9.81 * Vector3(std::sin(tilt), 0, -std::cos(tilt)));
    const int ball = scene.body(Sphere{radius}, 0.2, rough_surface(friction, 0),
                                {.p = {0, 0.3, radius}, .w = {0, turn * 0.3 / radius, 0}});
    scene.turntable(turn, rough_surface(friction, 0));
    scene.begin().locate_events();
    const Work work = run_located(scene.simulation(), duration, 0.01);
    CHECK(work.events == 0);
    CHECK(work.problems < 100 * duration * 28 * 2);  // 28 problems a segment
    const complex<double> r = rolled({0, 0.3}, 0, 9.81 * std::sin(tilt), turn, duration);
    CHECK((scene.position(ball) - Vector3(r.real(), r.imag(), radius)).norm() < 1e-9);
  }
}

TEST_CASE("event steps: a rolling coin moves alike with any friction, at the same cost") {
  const RollingCoin moderate(20);
  CHECK(moderate.work.problems > 0);
  for (const double friction : {50.0, 1000.0}) {
    CAPTURE(friction);
    const RollingCoin rough(friction);
    CHECK((rough.scene.position(rough.coin) - moderate.scene.position(moderate.coin)).norm() <
          1e-9);
    CHECK(rough.work.problems < 2 * moderate.work.problems);
    CHECK(rough.work.events <= moderate.work.events + 1);
  }
}

TEST_CASE("event steps: a sphere that rolls on a table of growing tilt slides where its cone ends") {
  // Gravity cannot turn in a scene; the slope is that of a bowl, in which the sphere rolls down
  // from the height where friction is too small to roll: sliding, then rolling.
  constexpr double friction = 0.2, radius = 0.1, bowl = 1;
  ContactScene scene;
  scene.set_gravity({0, 0, -9.81});
  scene.obstacle(SphericalCavity{bowl}, rough_surface(friction, 0));
  scene.body(Sphere{radius}, 1, rough_surface(friction, 0), {{bowl - radius, 0, 0}});
  scene.begin().locate_events();
  const double before = scene.energy();
  const Work work = run_located(scene.simulation(), 2, 0.01);
  CHECK(work.events > 0);
  CHECK(work.events < 30);
  REQUIRE(scene.contacts().work().size() == 1);
  const ContactWork& lost = scene.contacts().work()[0];
  CHECK(lost.friction < -0.1);
  CHECK(std::abs(scene.energy() - before - lost.friction) < 1e-8);
}
