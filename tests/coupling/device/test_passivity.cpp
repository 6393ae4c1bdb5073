// Passivity of force feedback, with an independent energy account of each held force.
#include <doctest/doctest.h>

#include <cmath>
#include <deque>
#include <numbers>

#include "coupling/device/passivity.h"
#include "tests/solver/dynamics/random_tree.h"
#include "tests/support/count_allocations.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

constexpr double kPeak = 3.3, kMaxDistance = 1e-3;  // [N], [m] a tick

struct EnergyBalance {
  double E = 0, lowest = 0;
  long in_debt = 0, paid_at_once = 0, unpaid = 0;

  // `motion(n, force)` gives the next position from the last force, `wanted(n, x)` the
  // environment's force.
  template <class Motion, class Wanted>
  void run(long ticks, Motion&& motion, Wanted&& wanted, bool control = true) {
    PassivityControl passivity(kPeak * kMaxDistance);
    Vector3 x = Vector3::Zero(), force = Vector3::Zero(), before = x, d = x;
    for (long n = 0; n < ticks; ++n) {
      before = x;
      x = motion(n, force);
      const Vector3 way = x - before;
      const bool owed = E < 0;
      if (n > 0) E -= force.dot(way);
      lowest = std::min(lowest, E);
      // The deficit is removed by the next tick that moves by at least half of the motion before.
      const bool moves_on = way.dot(d) >= 0.5 * d.squaredNorm() && way != Vector3::Zero();
      if (owed && way != Vector3::Zero()) {
        ++in_debt;
        if (E >= -1e-15) ++paid_at_once;
        if (moves_on && E < -1e-15 && !clamped_) ++unpaid;
      }
      if (way != Vector3::Zero()) d = way;
      const Vector3 w = wanted(n, x);
      if (control) {
        force = passivity.tick(x, w, kPeak);
        CHECK_MESSAGE(std::abs(passivity.energy() - E) < 1e-9,
                      "the observer is not the energy_balance");
        clamped_ = force.norm() >= kPeak * passivity.force_fraction() * (1 - 1e-9);
      } else {
        force = w.norm() > kPeak ? Vector3(w * (kPeak / w.norm())) : w;
      }
    }
  }

 private:
  bool clamped_ = false;
};

}  // namespace

TEST_CASE("passivity: 10^6 ticks of random motion stay above minus one tick's work") {
  for (const bool in_space : {false, true}) {
    Random random(11);
    Vector3 x = Vector3::Zero();
    EnergyBalance energy_balance;
    const auto any = [&](double size) {
      Vector3 v = random.vector(size);
      if (!in_space) v.y() = v.z() = 0;
      return v;
    };
    energy_balance.run(
        1000000,
        [&](long, const Vector3&) {
          if (random.integer(0, 3) > 0) x += any(kMaxDistance / std::sqrt(3.0));
          return x;
        },
        [&](long, const Vector3&) { return any(2 * kPeak); });
    CHECK(energy_balance.lowest >= -kPeak * kMaxDistance * (1 + 1e-3));
    CHECK(energy_balance.in_debt > 1000);
    CHECK(energy_balance.unpaid == 0);
  }
}

TEST_CASE("passivity: a motion that always follows the force gains at most one tick's work") {
  Vector3 x = Vector3::Zero();
  EnergyBalance energy_balance;
  energy_balance.run(
      200000,
      [&](long, const Vector3& force) {
        x.x() += force.x() >= 0 ? kMaxDistance : -kMaxDistance;
        return x;
      },
      [&](long n, const Vector3&) { return Vector3(n % 7 < 4 ? 9 : -9, 0, 0); });
  CHECK(energy_balance.lowest >= -kPeak * kMaxDistance * (1 + 1e-3));
  CHECK(energy_balance.lowest < -0.9 * kPeak * kMaxDistance);  // close to the bound
}

// A smooth motion with tremor up to 12 Hz: 10^6 ticks of 1 kHz against a wall with 100 ms delay,
// which would create unbounded energy.
TEST_CASE("passivity: 10^6 ticks at a delayed wall: every deficit is removed by the next motion") {
  const auto run = [](bool control, double quantum) {
    Random random(12);
    std::array<double, 6> phase{}, frequency{0.3, 0.9, 2.2, 5.1, 8.7, 12};
    std::array<double, 6> size{0.02, 0.01, 0.004, 0.0005, 0.0001, 0.0001};
    for (double& p : phase) p = random.uniform(0, 6);
    std::deque<double> late(100, 0.0);
    EnergyBalance energy_balance;
    energy_balance.run(
        1000000,
        [&](long n, const Vector3&) {
          double place = 0;
          for (std::size_t i = 0; i < 6; ++i)
            place += size[i] *
                     std::sin(2 * std::numbers::pi * frequency[i] * static_cast<double>(n) * 1e-3 +
                              phase[i]);
          return Vector3(quantum > 0 ? quantum * std::round(place / quantum) : place, 0, 0);
        },
        [&](long, const Vector3& x) {
          late.push_back(x.x() > 0 ? -400 * x.x() : 0.0);
          const double force = late.front();
          late.pop_front();
          return Vector3(force, 0, 0);
        },
        control);
    return energy_balance;
  };
  const EnergyBalance without = run(false, 0);
  CHECK(without.E < -10);  // 10 J and more from the wall
  for (const double quantum : {0.0, 0.055e-3}) {
    CAPTURE(quantum);
    const EnergyBalance with = run(true, quantum);
    CHECK(with.lowest > -kPeak * kMaxDistance / 2);
    CHECK(with.E > -kPeak * kMaxDistance / 2);
    CHECK(with.unpaid == 0);
    MESSAGE("lowest " << with.lowest << " J, ticks in debt that move " << with.in_debt
                      << ", paid at once " << with.paid_at_once);
  }
}

TEST_CASE("passivity: the published damping, alpha = -E/(T v^2), without other forces") {
  PassivityControl passivity(1.0);
  const double T = 1e-3;
  passivity.set_position(Vector3(0, 0, 0));
  passivity.set_held_force(Vector3(2, 0, 0));
  passivity.set_position(Vector3(1e-4, 0, 0));  // the force has moved the device
  CHECK(passivity.energy() == doctest::Approx(-2e-4));
  const double v = 1e-4 / T, alpha = 2 * 2e-4 / (T * v * v);  // twice: half the motion suffices
  const Vector3 force = passivity.passive_force(Vector3::Zero());
  CHECK(force.x() == doctest::Approx(-alpha * v));
}

TEST_CASE("passivity: a passive spring is not changed") {
  PassivityControl passivity(kPeak * kMaxDistance);
  double largest = 0;
  for (int n = 0; n <= 1000; ++n) {
    const double place = 0.004 * std::sin(std::numbers::pi * n / 1000.0);
    // Delayed by half a tick's motion, the energy of the hold.
    const double velocity = 0.004 * std::numbers::pi / 1000 * std::cos(std::numbers::pi * n / 1000);
    const double wanted = -500 * place - 500 * 0.6 * velocity;
    const Vector3 force = passivity.tick({place, 0, 0}, {wanted, 0, 0}, kPeak);
    largest = std::max(largest, std::abs(force.x() - wanted));
  }
  CHECK(largest < 1e-12);
}

TEST_CASE("passivity: after the worst motion a steady one has full force again, soon") {
  PassivityControl passivity(kPeak * kMaxDistance);
  double x = 0, force = 0;
  for (int n = 0; n < 100000; ++n) {
    x += force >= 0 ? kMaxDistance : -kMaxDistance;
    force = passivity.tick({x, 0, 0}, {9, 0, 0}, kPeak).x();
  }
  CHECK(std::abs(force) < 1e-6);
  int ticks = 0;
  while (passivity.energy() < 0 && ticks < 1000) {  // 0.2 m/s
    x += 0.2e-3;
    passivity.tick({x, 0, 0}, {-1, 0, 0}, kPeak);
    ++ticks;
  }
  CHECK(ticks < 200);
}

TEST_CASE("passivity: a tick does not allocate") {
  PassivityControl passivity(1.0);
  CHECK(allocations_in([&] {
          for (int n = 0; n < 1000; ++n)
            passivity.tick(Vector3::Constant(n % 7), Vector3::Constant(n % 3), 3.3);
        }) == 0);
}
