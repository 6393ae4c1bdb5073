// B1, B2, a point mass on a rod of 1 m, w0^2 = g / l (Landau, Lifshitz, Mechanics, section 11):
//   released at th0:  th = 2 asin(k cd(w0 t, k^2)),  k = sin(th0 / 2),  T = 4 K(k^2) / w0,
//   full turns:       th = 2 am(W t / 2, k^2),  k = 2 w0 / W,  W the rate at
//                     the bottom; a turn
//                     takes 4 K / W,
//   separatrix:       th = 4 atan(exp(w0 t)) - pi.
// B3, a uniform rod of 1 m, 1 kg, hinged at its end: a pendulum of 2/3 m. Released at the
// horizontal it has qdd = 3 g / 2 L, and the hinge carries m g / 4; at the bottom 5/2 m g. Kater's
// reversible pendulum: hinged at c or at c' from its centre it has the same period if c c' = L^2 /
// 12; so the period is shortest at L / sqrt(12).
#include "benchmarks/analytic/support/smooth_parts.h"

namespace twinarm {
namespace {

TrajectoryCase motion(CaseScene scene, std::vector<double> times, CaseReference reference) {
  return {.scene = fixed(std::move(scene)),
          .times = std::move(times),
          .readings = {"angle [rad]", "rate [rad/s]"},
          .observe = joint_state(),
          .reference = std::move(reference)};
}
// From a release at rest with k = sin(th0 / 2), k2 = k^2.
CaseReadings swinging(Real w0, Real k, Real k2, double t) {
  const special::Jacobi j = special::jacobi(w0 * Real(t), k2);
  return values(2 * std::asin(k * j.cn / j.dn), -2 * k * std::sqrt(1 - k2) * w0 * j.sn / j.dn);
}
double period_at_rest(ModelRef model, StateRef x) {
  return 2 * std::numbers::pi / small_frequencies(model, x)[0];
}

// From a release at rest: the angle is zero at odd quarters of the period.
TrajectoryCase swing_time(const Model<double>& model, Real w0, int degrees) {
  const Real amplitude = degrees * kPi / 180, k = std::sin(amplitude / 2);
  const Real quarter = special::quarter_period(k * k) / w0;
  return {.scene = fixed(start_at(model, {static_cast<double>(amplitude)}, {0})),
          .reference = [quarter](double n) { return values((2 * Real(n) - 1) * quarter); },
          .events = {coordinate(0), 3, 30}};
}

// ---- B1, B2 ----

const Real point_w0 = std::sqrt(Real(9.81L));

CaseScene released(double angle, double rate) {
  return start_at(point_pendulum(), {angle}, {rate});
}

TrajectoryCase swing() {
  return motion(released(std::numbers::pi / 2, 0), {1, 2, 5, 10},
                [](double t) { return swinging(point_w0, std::sqrt(0.5L), 0.5L, t); });
}
// The same motion in Cartesian coordinates: benchmark A01 of the IFToMM library.
TrajectoryCase swing_in_plane() {
  TrajectoryCase c = swing();
  const auto position = [](double angle) { return values(-std::sin(angle), -std::cos(angle)); };
  c.readings = {"x [m]", "y [m]"};
  c.observe = [position](ModelRef, StateRef x) { return position(x.q[0]); };
  c.times = {10};
  c.reference = [position, angle = c.reference](double t) { return position(angle(t)[0]); };
  return c;
}

constexpr Real kOver = 7;  // W [rad/s]
TrajectoryCase full_turns() {
  return motion(released(0, double(kOver)), {1, 5, 10}, [](double t) {
    const Real m = 4 * point_w0 * point_w0 / (kOver * kOver), u = kOver * Real(t) / 2;
    const special::Jacobi j = special::jacobi(u, m);
    const Real within = std::atan2(j.sn, j.cn);
    const Real about = u * kPi / (2 * special::quarter_period(m));
    const Real turns = std::round((about - within) / (2 * kPi));
    return values(2 * (within + 2 * kPi * turns), kOver * j.dn);
  });
}
TrajectoryCase turn_time() {
  const auto half_angle_sine = [](ModelRef, StateRef x) { return std::sin(x.q[0] / 2); };
  return times_of(full_turns(), {half_angle_sine, 3, 30}, [](double k) {
    const Real m = 4 * point_w0 * point_w0 / (kOver * kOver);
    return values(4 * special::quarter_period(m) / kOver * Real(k));
  });
}

TrajectoryCase separatrix() {
  return motion(released(0, static_cast<double>(2 * point_w0)), {0.25, 0.5, 1}, [](double t) {
    const Real u = point_w0 * Real(t);
    return values(4 * std::atan(std::exp(u)) - kPi, 2 * point_w0 / std::cosh(u));
  });
}

// ---- B3 ----

const Real rod_w0 = std::sqrt(1.5L * 9.81L);

// Hinged along y at a distance from its centre.
Model<double> rod(double to_centre) {
  return one_body(JointType::revolute, Vector3::UnitY(),
                  {1, {0, 0, -to_centre}, Vector3(1. / 12, 1. / 12, 0).asDiagonal()});
}
CaseScene rod_released(Real angle, double rate = 0) {
  return start_at(rod(0.5), {static_cast<double>(angle)}, {rate});
}

TrajectoryCase one_reading(Real angle, double rate, const char* reading, Observed observed,
                           double exact) {
  return evaluation(rod_released(angle, rate), {reading}, observe(std::move(observed)), {exact});
}

// Times of its swing, with a reading there that is the same each time.
TrajectoryCase rod_swing_time(int degrees, const char* reading, Observed observed, Real exact) {
  TrajectoryCase c = swing_time(rod(0.5), rod_w0, degrees);
  c.readings = {reading};
  c.observe = observe(std::move(observed));
  c.reference = [time = c.reference, exact](double n) { return values(time(n)[0], exact); };
  return c;
}
// From the horizontal to the bottom.
TrajectoryCase fall() {
  TrajectoryCase c = rod_swing_time(90, "rate [rad/s]", velocity(0), -std::sqrt(3 * 9.81L));
  c.events.count = 1;
  return c;
}

// sqrt(c c') for c = 0.5 m, by bisection for the other hinge of the same period.
double reversible(ModelRef model, StateRef x) {
  const auto frequency = [&](double c) { return small_frequencies(rod(c), x)[0]; };
  const double c = 0.5, target = small_frequencies(model, x)[0];
  double low = 0.01, high = 0.28;
  for (double middle; middle = (low + high) / 2, low < middle && middle < high;)
    (frequency(middle) < target ? low : high) = middle;
  return std::sqrt(c * high);
}

}  // namespace

CaseFamily pendulum_cases() {
  const auto acceleration = [](ModelRef model, StateRef x) { return -evaluate(model, x).qdd[0]; };
  const auto load = [](ModelRef model, StateRef x) { return reaction(model, x).z(); };
  const auto small_swings = evaluation(released(0, 0), {"period [s]"}, observe(period_at_rest),
                                       {static_cast<double>(2 * kPi / point_w0)});
  const double bottom_rate = std::sqrt(3 * kGravity);
  std::vector<AnalyticCase> all;
  for (const int degrees : {1, 10, 45, 90, 120, 150, 170, 179})
    all.push_back(
        {"B1-" + std::to_string(degrees), 1e-9, swing_time(point_pendulum(), point_w0, degrees)});
  all.insert(
      all.end(),
      {{"B1-small", 1e-12, small_swings},
       {"B2", 1e-8, swing()},
       {"B2-A01", 1e-8, swing_in_plane()},
       {"B2-over", 1e-8, full_turns()},
       {"B2-turn", 1e-8, turn_time()},
       {"B2-separatrix", 1e-6, separatrix()},
       {"B3", 1e-8,
        motion(rod_released(kPi / 3), {2},
               [](double t) { return swinging(rod_w0, 0.5L, 0.25L, t); })},
       {"B3-60", 1e-8, rod_swing_time(60, "angle [rad]", coordinate(0), 0)},
       {"B3-90", 1e-8, rod_swing_time(90, "angle [rad]", coordinate(0), 0)},
       {"B3-fall", 1e-8, fall()},
       {"B3-small", 1e-12,
        one_reading(0, 0, "period [s]", period_at_rest, static_cast<double>(2 * kPi / rod_w0))},
       {"B3-start", 1e-12,
        one_reading(kPi / 2, 0, "acceleration [rad/s2]", acceleration, 1.5 * kGravity)},
       {"B3-start-load", 1e-12, one_reading(kPi / 2, 0, "upward force [N]", load, kGravity / 4)},
       {"B3-load", 1e-12, one_reading(0, bottom_rate, "upward force [N]", load, 2.5 * kGravity)},
       {"B3-least", 1e-12, one_reading(0, 0, "minimum [m]", reversible, 1 / std::sqrt(12.0))}});
  return {50, all};
}

}  // namespace twinarm
