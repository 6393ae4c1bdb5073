// B3, a uniform rod of 1 m, 1 kg, hinged at its end: a pendulum of 2/3 m. Released at the
// horizontal it has qdd = 3 g / 2 L, the hinge carries m g / 4, at the bottom 5/2 m g. Kater's
// reversible pendulum: hinged at c and at c' from its centre it swings alike where c c' = L^2 / 12,
// so that the period is least at L / sqrt(12).
#include <cmath>
#include <numbers>

#include "benchmarks/analytic/support/reference_math.h"
#include "benchmarks/analytic/support/smooth_parts.h"

namespace twinarm {
namespace {

using namespace smooth_parts;
using Real = long double;

constexpr Real kPiOfRod = std::numbers::pi_v<Real>;
const Real rod_w0 = std::sqrt(1.5L * 9.81L);

// Hinged along y at a distance from its centre.
Model<double> rod(double to_centre) {
  return one_body(JointType::revolute, Vector3::UnitY(),
                  {1, {0, 0, -to_centre}, Vector3(1. / 12, 1. / 12, 0).asDiagonal()});
}
CaseScene rod_released(Real angle) {
  return start_at(rod(0.5), {static_cast<double>(angle)}, {0});
}

TrajectoryCase one_look(Real angle, double rate, const char* reading, CaseObserver observe,
                        double exact) {
  const auto swinging_rod = [=] {
    CaseScene moving = rod_released(angle);
    moving.start.qd[0] = rate;
    return moving;
  };
  return evaluation(swinging_rod, {reading}, std::move(observe), {exact});
}

template <int degrees>
TrajectoryCase rod_swing_time() {
  constexpr Real amplitude = degrees * kPiOfRod / 180;
  return {
      .scene = [] { return rod_released(amplitude); },
      .readings = {"angle [rad]"},
      .observe = [](const Model<double>&, const State<double>& x) { return CaseReadings{x.q[0]}; },
      .reference =
          [](double k) {
            const Real root = special::arithmetic_geometric_mean(1, std::cos(amplitude / 2));
            return rounded({(2 * Real(k) - 1) * kPiOfRod / (2 * rod_w0 * root), 0});
          },
      .events = {[](const Model<double>&, const State<double>& x) { return x.q[0]; }, 3, 30}};
}

TrajectoryCase rod_motion() {
  return {.scene = [] { return rod_released(kPiOfRod / 3); },
          .times = {2},
          .readings = {"angle [rad]", "rate [rad/s]"},
          .observe = joint_state(),
          .reference =
              [](double t) {
                const Real m = 0.25L, k = 0.5L;
                const special::Jacobi j = special::jacobi(rod_w0 * Real(t), m);
                return rounded({2 * std::asin(k * j.cn / j.dn),
                                -2 * k * std::sqrt(1 - m) * rod_w0 * j.sn / j.dn});
              }};
}

// From the horizontal down to the bottom: the rate there.
TrajectoryCase fall() {
  TrajectoryCase c = rod_swing_time<90>();
  c.readings = {"rate [rad/s]"};
  c.observe = [](const Model<double>&, const State<double>& x) { return CaseReadings{x.qd[0]}; };
  c.reference = [](double) {
    const Real root = special::arithmetic_geometric_mean(1, std::cos(kPiOfRod / 4));
    return rounded({kPiOfRod / (2 * rod_w0 * root), -std::sqrt(3 * 9.81L)});
  };
  c.events.count = 1;
  return c;
}

// The other hinge that swings alike, by bisection: its period falls, then rises with the distance.
CaseReadings reversible(const Model<double>& model, const State<double>& x) {
  const auto frequency = [&](double c) { return small_frequencies(rod(c), x)[0]; };
  const double c = 0.5, target = small_frequencies(model, x)[0];
  double low = 0.01, high = 0.28;
  for (double middle; middle = (low + high) / 2, low < middle && middle < high;)
    (frequency(middle) < target ? low : high) = middle;
  return {std::sqrt(c * high)};
}

}  // namespace

CaseFamily compound_pendulum_cases() {
  const auto small = [](const Model<double>& model, const State<double>& x) {
    return CaseReadings{2 * std::numbers::pi / small_frequencies(model, x)[0]};
  };
  const auto acceleration = [](const Model<double>& model, const State<double>& x) {
    return CaseReadings{-evaluate(model, x).qdd[0]};
  };
  const auto weight = [](const Model<double>& model, const State<double>& x) {
    return CaseReadings{reaction(model, x).z()};
  };
  const double bottom_rate = std::sqrt(3 * kGravity);
  return {60,
          {{"B3", 1e-8, rod_motion()},
           {"B3-60", 1e-8, rod_swing_time<60>()},
           {"B3-90", 1e-8, rod_swing_time<90>()},
           {"B3-fall", 1e-8, fall()},
           {"B3-small", 1e-12,
            one_look(0, 0, "period [s]", small, static_cast<double>(2 * kPiOfRod / rod_w0))},
           {"B3-start", 1e-12,
            one_look(kPiOfRod / 2, 0, "acceleration [rad/s2]", acceleration, 1.5 * kGravity)},
           {"B3-start-load", 1e-12,
            one_look(kPiOfRod / 2, 0, "upward force [N]", weight, kGravity / 4)},
           {"B3-load", 1e-12, one_look(0, bottom_rate, "upward force [N]", weight, 2.5 * kGravity)},
           {"B3-least", 1e-12, one_look(0, 0, "least [m]", reversible, 1 / std::sqrt(12.0))}}};
}

}  // namespace twinarm
