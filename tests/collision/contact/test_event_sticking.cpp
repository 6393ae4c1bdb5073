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
    const auto motion = [=](double t) {
      PrescribedMotion m;
      m.X_JL.R = Eigen::AngleAxisd(turn * t, Vector3::UnitZ()).toRotationMatrix();
      m.angular_velocity = turn * Vector3::UnitZ();
      return m;
    };
    scene.table(motion, rough_surface(friction, 0));
    scene.begin().locate_events();
    const Work work = run_located(scene.simulation(), duration, 0.01);
    CHECK(work.events == 0);
    CHECK(work.problems < 100 * duration * 3 * 28);  // 3 segments a step, 28 problems each
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

TEST_CASE("event steps: a box slides from when a table's acceleration exceeds its friction") {
  constexpr double g = 9.81, friction = 0.3, jerk = 10, start = friction * g / jerk;
  ContactScene scene;
  scene.set_gravity({0, 0, -g});
  const int box =
      scene.body(Box{{0.4, 0.4, 0.1}}, 2, rough_surface(friction, 0), {.p = {0, 0, 0.05}});
  const auto motion = [=](double t) {
    PrescribedMotion m;
    m.X_JL.p = jerk / 6 * t * t * t * Vector3::UnitX();
    m.velocity = jerk / 2 * t * t * Vector3::UnitX();
    m.acceleration = jerk * t * Vector3::UnitX();
    return m;
  };
  scene.table(motion, rough_surface(friction, 0));
  scene.begin().locate_events();
  const Work work = run_located(scene.simulation(), 1, 0.02);
  const double since = 1 - start;
  const double x = jerk / 6 * std::pow(start, 3) + jerk / 2 * start * start * since +
                   friction * g / 2 * since * since;
  CHECK(std::abs(scene.position(box).x() - x) < 1e-6);
  CHECK(work.events <= 3);
}
