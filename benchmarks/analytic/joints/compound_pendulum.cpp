// B3, a uniform rod of 1 m, 1 kg, hinged at its end: a pendulum of 2/3 m. Released at the
// horizontal it has qdd = 3 g / 2 L, the hinge carries m g / 4, at the bottom 5/2 m g. Kater's
// reversible pendulum: hinged at c and at c' from its centre it swings alike where c c' = L^2 / 12,
// so that the period is least at L / sqrt(12).
#include <cmath>
#include <numbers>

#include "benchmarks/analytic/joints/joint_cases.h"
#include "benchmarks/analytic/support/smooth_parts.h"
#include "benchmarks/analytic/support/special_functions.h"

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

TrajectoryCase one_look(const char* statement, Real angle, double rate, const char* reading,
                        CaseObserver observe, double exact) {
  return {.statement = statement,
          .scene =
              [=] {
                CaseScene scene = rod_released(angle);
                scene.start.qd[0] = rate;
                return scene;
              },
          .times = {0},
          .readings = {reading},
          .observe = std::move(observe),
          .reference = [exact](double) { return CaseReadings{exact}; },
          .measure = relative_to_largest};
}

template <int degrees>
TrajectoryCase rod_swing_time() {
  constexpr Real amplitude = degrees * kPiOfRod / 180;
  return {
      .statement =
          "A uniform rod of 1 m, hinged at its end, passes the bottom at odd quarters "
          "of <p>T = 2&pi; / (&omega;<sub>0</sub> agm(1, cos(&theta;<sub>0</sub>/2))), "
          "&omega;<sub>0</sub><sup>2</sup> = 3g/2L</p>",
      .scene = [] { return rod_released(amplitude); },
      .readings = {"angle [rad]"},
      .observe = [](const Model<double>&, const State<double>& x) { return CaseReadings{x.q[0]}; },
      .reference =
          [](double k) {
            const Real root = special::arithmetic_geometric_mean(1, std::cos(amplitude / 2));
            return CaseReadings{
                static_cast<double>((2 * Real(k) - 1) * kPiOfRod / (2 * rod_w0 * root)), 0};
          },
      .events = {[](const Model<double>&, const State<double>& x) { return x.q[0]; }, 3, 30}};
}

TrajectoryCase rod_motion() {
  return {.statement =
              "A uniform rod of 1 m, hinged at its end, is released from 60&deg;: <p>&theta; "
              "= 2 asin(k cd(&omega;<sub>0</sub>t)), k = 1/2</p>",
          .scene = [] { return rod_released(kPiOfRod / 3); },
          .times = {2},
          .readings = {"angle [rad]", "rate [rad/s]"},
          .observe = joint_state(),
          .reference =
              [](double t) {
                const Real m = 0.25L, k = 0.5L;
                const special::Jacobi j = special::jacobi(rod_w0 * Real(t), m);
                return CaseReadings{
                    static_cast<double>(2 * std::asin(k * j.cn / j.dn)),
                    static_cast<double>(-2 * k * std::sqrt(1 - m) * rod_w0 * j.sn / j.dn)};
              }};
}

// From the horizontal down to the bottom: the rate there.
TrajectoryCase fall() {
  TrajectoryCase c = rod_swing_time<90>();
  c.statement =
      "A uniform rod of 1 m falls from the horizontal: at the bottom <p>3g/L = "
      "&omega;<sup>2</sup></p>";
  c.readings = {"rate [rad/s]"};
  c.observe = [](const Model<double>&, const State<double>& x) { return CaseReadings{x.qd[0]}; };
  c.reference = [](double) {
    const Real root = special::arithmetic_geometric_mean(1, std::cos(kPiOfRod / 4));
    return CaseReadings{static_cast<double>(kPiOfRod / (2 * rod_w0 * root)),
                        -static_cast<double>(std::sqrt(3 * 9.81L))};
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
  const char* group = "joints";
  const auto small = [](const Model<double>& model, const State<double>& x) {
    return CaseReadings{2 * std::numbers::pi / small_frequencies(model, x)[0]};
  };
  const auto acceleration = [](const Model<double>& model, const State<double>& x) {
    return CaseReadings{-evaluate(model, x).qdd[0]};
  };
  const auto weight = [](const Model<double>& model, const State<double>& x) {
    return CaseReadings{reaction(model, x).z()};
  };
  const char* hinged =
      "A uniform rod of 1 kg and 1 m, hinged at its end: <p>&theta;'' = &minus;(3g/2L) sin "
      "&theta;</p> "
      "At the horizontal the hinge carries m g/4; at the bottom, come from there, 5 m g/2.";
  const double bottom_rate = std::sqrt(3 * kGravity);
  const std::vector<AnalyticCase> cases = {
      trajectory_case("B3", group, "rod from 60 degrees: angle [rad], rate [rad/s] at 2 s", 1e-8,
                      rod_motion()),
      trajectory_case("B3-60", group, "rod, period from 60 degrees: 1.7578148046738582 s [s]", 1e-8,
                      rod_swing_time<60>()),
      trajectory_case("B3-90", group, "rod, period from 90 degrees: 1.9333348543732458 s [s]", 1e-8,
                      rod_swing_time<90>()),
      trajectory_case("B3-fall", group,
                      "rod from the horizontal: time, rate 5.4249423960075373 at the bottom [s, "
                      "rad/s]",
                      1e-8, fall()),
      trajectory_case(
          "B3-small", group, "rod, small swings: 1.6379465859132759 s [relative]", 1e-12,
          one_look(hinged, 0, 0, "period [s]", small, static_cast<double>(2 * kPiOfRod / rod_w0))),
      trajectory_case(
          "B3-start", group, "rod at the horizontal: 14.715 rad/s^2 [relative]", 1e-12,
          one_look(hinged, kPiOfRod / 2, 0, "acceleration [rad/s2]", acceleration, 1.5 * kGravity)),
      trajectory_case("B3-start-load", group, "the same: the hinge carries m g / 4 [relative]",
                      1e-12,
                      one_look(hinged, kPiOfRod / 2, 0, "upward force [N]", weight, kGravity / 4)),
      trajectory_case("B3-load", group, "rod at the bottom: the hinge carries 5/2 m g [relative]",
                      1e-12,
                      one_look(hinged, 0, bottom_rate, "upward force [N]", weight, 2.5 * kGravity)),
      trajectory_case("B3-least", group,
                      "hinge of the least period: 0.28867513459481288 m from the centre [relative]",
                      1e-12,
                      one_look("A uniform rod swings alike about two hinges, c and c' from its "
                               "centre: <p>c c' = L<sup>2</sup>/12</p>",
                               0, 0, "least [m]", reversible, 1 / std::sqrt(12.0))),
  };
  return {60, cases};
}

}  // namespace twinarm
