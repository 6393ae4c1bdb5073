// Desktop input (mouse, keys, sticks) and the triple buffer.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <thread>

#include "coupling/device/desktop_input.h"
#include "coupling/device/virtual_omni.h"
#include "coupling/target/scripted_motion.h"
#include "tests/support/count_allocations.h"

using namespace twinarm;

namespace {

Vector3 point_of(const OperatorSample& hand) {
  return omni_position({}, hand.theta);
}
Vector3 velocity_of(const OperatorSample& hand) {
  const auto& rate = hand.theta_dot;
  return omni_jacobian({}, hand.theta) * Vector3(rate[0], rate[1], rate[2]);
}

// Starting from the position at the time t.
void move(DesktopInput& hand, const Vector3& by, double t = 0) {
  hand.place(point_of(hand.sample(t, t + 1)) + by);
}

}  // namespace

TEST_CASE("desktop input: the stylus moves to a point, and rotates by angles") {
  DesktopInput hand{OmniParameters{}};
  const Vector3 start = point_of(hand.sample(0, 1));
  CHECK((start - omni_position({}, DesktopInput::kStart)).norm() < 1e-12);
  hand.place(start + Vector3(0.010, 0.005, -0.008));
  CHECK((point_of(hand.sample(0, 1)) - start - Vector3(0.010, 0.005, -0.008)).norm() < 1e-12);
  hand.rotate_stylus({0.6, -0.3, -0.12});
  const OperatorSample turned = hand.sample(0, 1);
  CHECK(turned.theta[3] == doctest::Approx(0.6));
  CHECK(turned.theta[4] == doctest::Approx(0.6 - 0.3));
  CHECK(turned.theta[5] == doctest::Approx(-0.12));
}

TEST_CASE(
    "desktop input: keys and sticks move at constant rates in the reader's time, until released") {
  DesktopInput hand{OmniParameters{}};
  const Vector3 start = point_of(hand.sample(5, 6));
  hand.key(DeviceAxis::right, true, true);
  hand.axes(
      {0.05, 0.54, 0, 0, 0, 1.5});  // at rest within the dead zone; half of the rest; too much
  const OperatorSample later = hand.sample(5.2, 6);
  CHECK((point_of(later) - start - Vector3(0.020, 0.010, 0)).norm() < 1e-12);
  CHECK((velocity_of(later) - Vector3(0.1, 0.05, 0)).norm() < 1e-3);
  CHECK(later.theta[5] == doctest::Approx(0.2 * 1.5));
  CHECK(later.theta_dot[5] == doctest::Approx(1.5));
  hand.key(DeviceAxis::right, false, true);  // both keys: neither
  CHECK((point_of(hand.sample(5.3, 6)) - start - Vector3(0.020, 0.015, 0)).norm() < 1e-12);
  hand.key(DeviceAxis::right, true, false);
  CHECK((point_of(hand.sample(5.4, 6)) - start - Vector3(0.010, 0.020, 0)).norm() < 1e-12);
  hand.button(0, true);
  hand.button(1, true);
  CHECK(hand.sample(5.4, 6).button);
  CHECK(hand.sample(5.4, 6).clutch);
  hand.release();
  const OperatorSample rest = hand.sample(9, 10);
  CHECK((point_of(rest) - start - Vector3(0.010, 0.020, 0)).norm() < 1e-12);
  CHECK(rest.theta_dot == std::array<double, 6>{});
  CHECK_FALSE(rest.button);
  CHECK_FALSE(rest.clutch);
}

TEST_CASE("desktop input: out of reach the goal is the nearest point, and it comes back at once") {
  const OmniParameters omni;
  DesktopInput hand{omni};
  const Vector3 start = point_of(hand.sample(0, 1));
  move(hand, {2, 0, 0});
  const OperatorSample edge = hand.sample(0, 1);
  const auto expected = omni_nearest(omni, start + Vector3(2, 0, 0));
  CHECK((point_of(edge) - omni_position(omni, {expected[0], expected[1], expected[2]})).norm() <
        1e-12);
  move(hand, {-0.010, 0, 0});
  CHECK((point_of(hand.sample(0, 1)) - point_of(edge) - Vector3(-0.010, 0, 0)).norm() < 1e-9);
  // A pressed key at the boundary does not wind up either.
  move(hand, {2, 0, 0});
  hand.key(DeviceAxis::right, true, true);
  hand.sample(10, 11);
  hand.key(DeviceAxis::right, true, false);
  const Vector3 held = point_of(hand.sample(10, 11));
  hand.key(DeviceAxis::right, false, true);
  CHECK((point_of(hand.sample(10.1, 11)) - held - Vector3(-0.010, 0, 0)).norm() < 1e-9);
  move(hand, {2, 0, 0}, 10.1);  // against the pressed key: it moves back from the boundary
  const Vector3 pushed = point_of(hand.sample(10.1, 11));
  CHECK((point_of(hand.sample(10.2, 11)) - pushed - Vector3(-0.010, 0, 0)).norm() < 1e-9);
  hand.release();
  for (int n = 0; n < 400; ++n) {  // always within the ranges
    move(hand, {0.15 * std::sin(1.7 * n), 0.15 * std::cos(0.9 * n), 0.08 * std::sin(2.3 * n)},
         12 + 0.01 * n);
    hand.rotate_stylus({3 * std::sin(n), 2.4 * std::cos(n), 2.4 * std::cos(3.1 * n)});
    const OperatorSample now = hand.sample(12 + 0.01 * n, 20);
    for (std::size_t j = 0; j < 6; ++j)
      CHECK_UNARY(now.theta[j] >= omni.lower[j] && now.theta[j] <= omni.upper[j]);
  }
}

TEST_CASE("desktop input: values that are not finite are ignored, no allocation") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  DesktopInput hand{OmniParameters{}};
  const Vector3 start = point_of(hand.sample(0, 1));
  const long taken = testing::allocations_in([&] {
    hand.place({nan, 0, 0});
    hand.rotate_stylus({0, 0, nan});
    hand.axes({nan, nan, 0, 0, nan, 1e300});
    hand.button(7, true);
    hand.sample(0, 1);
  });
  CHECK(taken == 0);
  CHECK((point_of(hand.sample(0, 1)) - start).norm() < 1e-12);
}

TEST_CASE("desktop input moves the virtual Omni's stylus to the point, through the arm") {
  const auto hand = std::make_shared<DesktopInput>(OmniParameters{});
  VirtualOmniSettings settings;
  settings.parameters.friction = 0;
  VirtualOmni omni(hand, settings);
  omni.poll(0);
  const Vector3 start = omni.truth().position;
  move(*hand, {0.030, 0, 0});
  hand->button(1, true);
  DeviceState seen;
  for (int n = 0; n < 1000; ++n) seen = omni.poll(1e-3 * n);
  CHECK((omni.truth().position - start - Vector3(0.030, 0, 0)).norm() < 1e-6);
  CHECK(seen.buttons == std::array<bool, 2>{false, true});
}

TEST_CASE("triple buffer: values are never torn, never out of order, and the last one arrives") {
  struct Pair {
    long a, b;
    std::array<long, 30> more;
  };
  constexpr long kLast = 200000;
  TripleBuffer<Pair> newest(Pair{0, 0, {}});
  std::thread writer([&] {
    for (long n = 1; n <= kLast; ++n) {
      Pair next{n, -n, {}};
      next.more.fill(n);
      newest.write(next);
    }
  });
  long last = 0;
  bool good = true;
  for (long reads = 0; last < kLast && reads < 2000000000; ++reads) {
    const Pair& pair = newest.read();
    good = good && pair.b == -pair.a && pair.a >= last;
    for (const long more : pair.more) good = good && more == pair.a;
    last = pair.a;
  }
  writer.join();
  CHECK(good);
  CHECK(last == kLast);
}
