// The virtual Omni against closed forms: a mass under a force, a mass on a spring, Coulomb
// friction, the stability limit of a wall with held force.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/coupling/device/virtual_omni_tries.h"

using namespace twinarm;
using namespace twinarm::testing;

TEST_CASE("virtual Omni, free: a force F moves 45 g by F t^2 / (2 m); 10 N are limited to 3.3 N") {
  const Vector3 way = Vector3(1, 2, -1).normalized();
  for (const double F : {0.05, 0.4, 10.0}) {
    VirtualOmni omni(resting_hand(), not_held(closed_form()));
    const Vector3 start = omni.truth().position;
    const double t = F > 3 ? 0.02 : 0.1, most = std::min(F, 3.3);
    run_ticks(omni, 0, static_cast<int>(std::round(t / kTick)),
              [&](int, const DeviceState&) { return Vector3(F * way); });
    const double s = most * t * t / (2 * 0.045);
    // Remaining error: rotation of the arm under torques held for a tick.
    CHECK((omni.truth().position - start - s * way).norm() < 0.01 * s);
    CHECK(omni.truth().motors.norm() == doctest::Approx(most).epsilon(0.02));
    CHECK(omni.truth().motors.norm() <= 3.3 + 1e-12);
  }
}

TEST_CASE(
    "virtual Omni, held: the arm deflects by F / k, on the closed form of a mass on a spring") {
  VirtualOmniSettings s = closed_form();
  VirtualOmni omni(resting_hand(), s);
  const double k = 300, b = 5, m = 0.145, F = 0.5;
  const double w = std::sqrt(k / m), z = b / (2 * std::sqrt(k * m)), wd = w * std::sqrt(1 - z * z);
  const Vector3 way = Vector3(0.5, -1, 0.3).normalized(), start = omni.truth().position;
  double worst = 0;
  for (int n = 0; n < 1500; ++n) {
    const DeviceState seen = omni.poll(n * kTick);
    const double t = n * kTick;
    const double x =
        F / k * (1 - std::exp(-z * w * t) * (std::cos(wd * t) + z * w / wd * std::sin(wd * t)));
    worst = std::max(worst, (omni.truth().position - start - x * way).norm());
    push_stylus(omni, seen, F * way);
  }
  CHECK(worst < 2e-3 * F / k);  // torques held while the arm rotates
  CHECK((omni.truth().position - start - F / k * way).norm() < 1e-9);
}

TEST_CASE("virtual Omni: no error behind a goal of constant velocity; closed-form step response") {
  // A slow chirp is nearly constant velocity; relative damper.
  DeviceAngles to = kPosture;
  to[2] += 0.02;
  VirtualOmni omni(std::make_shared<StepMotion>(kPosture, to, 0.01, 5), closed_form());
  const Vector3 from = omni.truth().position;
  omni.poll(0);
  const double k = 300, b = 5, m = 0.145;
  const double w = std::sqrt(k / m), z = b / (2 * std::sqrt(k * m)), wd = w * std::sqrt(1 - z * z);
  double worst = 0;
  for (int n = 0; n < 600; ++n) {
    omni.poll(n * kTick);
    const double t = std::max(n * kTick - 0.01, 0.0);
    const double u = std::exp(-z * w * t) * (std::cos(wd * t) + z * w / wd * std::sin(wd * t));
    OmniAngles goal{};
    std::copy(to.begin(), to.end(), goal.begin());
    const Vector3 g = omni_position(omni.parameters(), goal);
    worst = std::max(worst, (omni.truth().position - g - u * (from - g)).norm());
  }
  CHECK(worst < 1e-12);
  VirtualOmni slow(std::make_shared<ReachMotion>(kPosture, to, 0, 4.0), closed_form());
  double lag = 0;
  for (int n = 0; n < 4000; ++n) {
    slow.poll(n * kTick);
    lag = std::max(lag, (slow.truth().position - slow.truth().goal).norm());
  }
  // a_max / w^2 of the reach, 5.77 D / T^2 (docs/understand/tracking_error.md); an absolute damper:
  // b v / k = 30 um.
  CHECK(lag < 2 * 5.7735 * 0.02 * 0.13335 / 16 / (w * w));
}

TEST_CASE("virtual Omni: friction holds the point without creep, up to 0.26 N") {
  VirtualOmniSettings s = not_held(closed_form());
  s.parameters.friction = 0.26;
  const Vector3 way = Vector3(-0.2, 1, 0.4).normalized();
  VirtualOmni held(resting_hand(), s), slides(resting_hand(), s);
  const Vector3 start = held.truth().position;
  // Both with vibration: a stick that creeps would ratchet.
  run_ticks(held, 0, 3000,
            [&](int n, const DeviceState&) { return Vector3((0.2599 * std::cos(0.5 * n)) * way); });
  CHECK(std::memcmp(held.truth().position.data(), start.data(), 24) == 0);
  CHECK(held.truth().sticks);
  run_ticks(slides, 0, 100, [&](int, const DeviceState&) { return Vector3(0.36 * way); });
  const double t = 0.1, v = 0.1 / 0.045 * t;
  CHECK((slides.truth().position - start - 0.5 * v * t * way).norm() < 0.01 * 0.5 * v * t);
  CHECK_FALSE(slides.truth().sticks);
  // Released: it stops after m v^2 / (2 f), and stays.
  const Vector3 free = slides.truth().position;
  const double speed = slides.truth().velocity.norm();
  run_ticks(slides, 100, 400, [](int, const DeviceState&) { return Vector3(0, 0, 0); });
  const double stop = 0.045 * speed * speed / (2 * 0.26);
  CHECK((slides.truth().position - free).norm() == doctest::Approx(stop).epsilon(2e-3));
  CHECK(slides.truth().velocity == Vector3(0, 0, 0));
  CHECK(slides.truth().sticks);
}

TEST_CASE("virtual Omni: a slowly moving arm moves the stylus once its spring has 0.26 N") {
  VirtualOmniSettings s = closed_form();
  s.parameters.friction = 0.26;
  s.arm.damping = 0.5;
  DeviceAngles to = kPosture;
  to[2] += 0.05;
  VirtualOmni omni(std::make_shared<ReachMotion>(kPosture, to, 0, 10.0), s);
  const Vector3 start = omni.truth().position;
  int moves = -1;
  double most = 0;
  for (int n = 0; n < 12000; ++n) {
    omni.poll(n * kTick);
    const double offset = (omni.truth().goal - omni.truth().position).norm();
    if (moves < 0 && omni.truth().position != start) {
      moves = n;
      CHECK(offset == doctest::Approx(0.26 / 300).epsilon(5e-3));
    }
    most = std::max(most, offset);
  }
  CHECK(moves > 1000);  // at rest for seconds, bit-identical to its start
  CHECK(most == doctest::Approx(0.26 / 300).epsilon(5e-3));  // kinetic friction is equal
  CHECK(omni.truth().sticks);                                // and rests before the goal
  CHECK((omni.truth().goal - omni.truth().position).norm() > 0.5 * 0.26 / 300);
}

TEST_CASE("virtual Omni: without motors and with a goal at rest its energy never grows") {
  VirtualOmniSettings s = closed_form();
  for (const double friction : {0.0, 0.1}) {
    s.parameters.friction = friction;
    s.arm.damping = friction > 0 ? 0 : 5;
    DeviceAngles away = kPosture;
    away[0] += 0.7, away[2] -= 0.6;  // beyond a joint limit on its way
    VirtualOmni omni(std::make_shared<StepMotion>(away, kPosture, 0, 2), s);
    const double m = 0.145, k = 300;
    double energy = std::numeric_limits<double>::infinity();
    for (int n = 0; n < 2000; ++n) {
      omni.poll(n * kTick);
      const auto& x = omni.truth();
      if (n == 0) continue;
      const double now =
          0.5 * m * x.velocity.squaredNorm() + 0.5 * k * (x.position - x.goal).squaredNorm();
      CHECK_UNARY(now <= energy * (1 + 1e-12) + 1e-18);
      energy = now;
    }
    CHECK(energy < 0.5 * k * std::pow(0.1 / 300 + 1e-9, 2));  // at most what friction can hold
  }
}

TEST_CASE("virtual Omni: stable at any stiffness of the arm") {
  VirtualOmniSettings s = closed_form();
  s.arm.stiffness = 1e7;  // w h = 2.1 of a substep, without damping
  s.arm.damping = 0;
  DeviceAngles to = kPosture;
  to[0] += 0.01;
  VirtualOmni omni(std::make_shared<StepMotion>(kPosture, to, 0.01, 3), s);
  double farthest = 0;
  const Vector3 from = omni.truth().position;
  for (int n = 0; n < 3000; ++n) {
    omni.poll(n * kTick);
    farthest = std::max(farthest, (omni.truth().position - omni.truth().goal).norm());
  }
  CHECK(farthest < (omni.truth().goal - from).norm() * (1 + 1e-9));
}

TEST_CASE("virtual Omni: a wall is stable up to the exact limit of the held force, 2152.5 N/m") {
  // m = 45 g, b = 0.1, wall damping B = 1 N s/m by backward differences, T = 1 ms; one tick of
  // delay: 715.7 N/m. Both are eigenvalue limits of the sampled system
  // (docs/understand/phantom_omni.md).
  struct Limit {
    double K, delay;
  };
  for (const Limit& limit : {Limit{2152.5, 0}, Limit{715.7, kTick}})
    for (const double part : {0.985, 1.015}) {
      VirtualOmniSettings s = not_held(closed_form());
      s.device_damping = 0.1;
      s.delay_to_motors = limit.delay;
      VirtualOmni omni(resting_hand(), s);
      const Vector3 wall = omni.truth().position - Vector3(0, 1e-7, 0);
      double last = 1e-7, first = 0, end = 0;
      run_ticks(omni, 0, 6000, [&](int n, const DeviceState& seen) {
        const double y = seen.stylus.p.y() - wall.y();
        const double F = -part * limit.K * y - 1.0 * (y - last) / kTick;
        last = y;
        if (n >= 100 && n < 200) first = std::max(first, std::abs(y));
        if (n >= 5800) end = std::max(end, std::abs(y));
        return Vector3(0, F, 0);
      });
      INFO(limit.K, " ", part, " ", first, " ", end);
      CHECK((end > first) == (part > 1));
    }
}
