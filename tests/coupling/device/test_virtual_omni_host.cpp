// The virtual Omni's interface: encoder counts, ticks, held forces, delays, ranges, invalid input.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "solver/support/diagnostics.h"
#include "tests/coupling/device/virtual_omni_tries.h"
#include "tests/support/count_allocations.h"

using namespace twinarm;
using namespace twinarm::testing;

TEST_CASE(
    "virtual Omni: angles are whole encoder counts, one of the elbow 0.055 mm at the stylus") {
  VirtualOmniSettings s;
  DeviceAngles to = kPosture;
  for (double& theta : to) theta += 0.3;
  VirtualOmni omni(std::make_shared<ReachMotion>(kPosture, to, 0, 0.5), s);
  const double count = 0.055e-3 / 0.13335;
  int values = 0;
  double last = 0;
  for (int n = 0; n < 600; ++n) {
    const DeviceState seen = omni.poll(n * kTick);
    for (std::size_t j = 0; j < 6; ++j) {
      CHECK_UNARY(std::abs(seen.theta[j] - omni.truth().theta[j]) <= 0.5 * count + 1e-15);
      CHECK_UNARY(std::abs(seen.theta[j] / count - std::round(seen.theta[j] / count)) < 1e-9);
    }
    CHECK_UNARY((seen.stylus.p - omni_stylus(s.parameters, seen.theta).p).norm() == 0);
    values += seen.theta[2] != last ? 1 : 0;
    last = seen.theta[2];
  }
  CHECK(values > 100);
  OmniAngles a{0, 0.5, 0, 0, 0, 0}, b = a;
  b[2] += count;
  CHECK((omni_position(s.parameters, a) - omni_position(s.parameters, b)).norm() ==
        doctest::Approx(0.055e-3));
}

TEST_CASE("virtual Omni: forces act from its own ticks on and are held between them") {
  const Vector3 way = Vector3(0, 1, 0);
  const auto torque = [&](const VirtualOmni& omni, double F) {
    OmniAngles at = kPosture;
    return DeviceForce{omni_torque(omni.parameters(), at, F * way)};
  };
  VirtualOmni plain(resting_hand(), closed_form()), quick(resting_hand(), closed_form()),
      slow(resting_hand(), closed_form()), often(resting_hand(), closed_form());
  const auto wanted = [](int n) { return 0.5 * std::sin(0.3 * n); };
  for (int n = 0; n < 200; ++n) {
    const DeviceState a = plain.poll(n * kTick), b = quick.poll(n * kTick);
    CHECK_UNARY(same_bits(a, b));
    plain.render(torque(plain, wanted(n)));
    // A host at 4 kHz: the last force before a tick counts.
    quick.render(torque(quick, wanted(n)));
    for (int i = 1; i < 4; ++i) {
      const DeviceState between = quick.poll((n + 0.25 * i) * kTick);
      CHECK_UNARY(same_bits(between, a));
      CHECK(between.t == n * kTick);
      quick.render(torque(quick, -1.0 * i));
    }
  }
  for (int n = 0; n < 200; ++n) {  // a host at 50 Hz and one that repeats its force: the same hold
    if (n % 20 == 0) slow.render(torque(slow, wanted((slow.poll(n * kTick), n))));
    often.poll(n * kTick);
    often.render(torque(often, wanted(n - n % 20)));
  }
  CHECK_UNARY(same_bits(slow.poll(0.2), often.poll(0.2)));
}

TEST_CASE("virtual Omni: delays shift measurements and forces in time") {
  DeviceAngles to = kPosture;
  for (double& theta : to) theta += 0.2;
  const auto hand = std::make_shared<ReachMotion>(kPosture, to, 0.01, 0.1);
  VirtualOmniSettings late = closed_form();
  late.delay_to_host = 0.0073;
  late.delay_to_motors = 0.005;
  VirtualOmniSettings shifted = closed_form();
  VirtualOmni now(hand, shifted), then(hand, late), early(hand, shifted);
  std::vector<DeviceState> seen;
  for (int n = 0; n < 150; ++n) {
    const double t = n * kTick;
    // The same torques five ticks later, against a delay of five.
    seen.push_back(now.poll(t));
    now.render({{0, n < 5 ? 0 : 0.01 * std::sin(0.2 * (n - 5)), 0}});
    const DeviceState old = then.poll(t);
    then.render({{0, 0.01 * std::sin(0.2 * n), 0}});
    const auto at =
        static_cast<std::size_t>(std::max(n - 8, 0));  // the last tick before t - 7.3 ms
    CHECK_UNARY(same_bits(old, seen[at]));
    CHECK(old.t == seen[at].t);
  }
  CHECK_FALSE(same_bits(seen[20], seen[140]));
}

TEST_CASE("virtual Omni: joints stop at their limits, inelastically, and leave them at once") {
  DeviceAngles far = kPosture;
  far = {2.0, 2.5, -1.5, 3, 3, -3};
  VirtualOmniSettings s = closed_form();
  VirtualOmni omni(std::make_shared<StepMotion>(far, kPosture, 0.5, 1), s);
  const OmniParameters& o = omni.parameters();
  OmniAngles goal{};
  std::copy(far.begin(), far.end(), goal.begin());
  for (int n = 0; n < 1500; ++n) {
    const DeviceState seen = omni.poll(n * kTick);
    for (std::size_t j = 0; j < 6; ++j)
      CHECK_UNARY(seen.theta[j] >= o.lower[j] && seen.theta[j] <= o.upper[j]);
    if (n == 499) {  // at the reachable point nearest to the goal, at rest
      const auto q = omni_nearest(o, omni_position(o, goal));
      const Vector3 edge = omni_position(o, {q[0], q[1], q[2], 0, 0, 0});
      CHECK((omni.truth().position - edge).norm() < 1e-6);
      CHECK(omni.truth().velocity.norm() < 1e-3);
    }
  }
  CHECK((omni.truth().position - omni.truth().goal).norm() < 1e-5);  // it has left the limit
}

TEST_CASE("virtual Omni: robust against any force, without allocation") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = 1e308 * 10;
  VirtualOmni omni(resting_hand(), {});
  const Vector3 start = omni.truth().position;
  double last = -1;
  bool good = true;
  const long taken = allocations_in([&] {
    for (const double now : {nan, 0.0, 0.01, 0.005, inf, -3.0, 0.02, 1e9, 1e9 + 0.001, nan}) {
      const DeviceState seen = omni.poll(now);
      omni.render({{nan, inf, -inf}});
      good = good && seen.stylus.p.allFinite() && std::isfinite(seen.t) && seen.t >= last;
      last = seen.t;
      omni.poll(now + 0.003);
      omni.render({{1e200, -1e200, 3}});
    }
  });
  CHECK(good);
  CHECK(taken == 0);
  // No valid force was given: it has not moved.
  CHECK(omni.truth().position == start);
  CHECK(omni.truth().velocity == Vector3(0, 0, 0));
}

TEST_CASE("virtual Omni: invalid settings are rejected with all their errors") {
  VirtualOmniSettings s;
  s.parameters.rate = 0;
  s.arm.stiffness = -1;
  s.arm.mass = std::numeric_limits<double>::quiet_NaN();
  s.delay_to_host = -0.1;
  try {
    VirtualOmni omni(resting_hand(), s);
    FAIL("not refused");
  } catch (const InputError& error) {
    CHECK(error.faults().size() >= 4);
  }
}
