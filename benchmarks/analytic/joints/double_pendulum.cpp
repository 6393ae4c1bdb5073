// C1, C2, C10: double pendulums in a plane. With a1, a2 from the vertical, J about the joint or
// the centre of mass, K = m2 l1 c2, d = a1 - a2 (Lagrange):
//   (J1 + m1 c1^2 + m2 l1^2) a1'' + K cos d a2'' + K sin d a2'^2 + (m1 c1 + m2 l1) g sin a1 = 0,
//   K cos d a1'' + (J2 + m2 c2^2) a2'' - K sin d a1'^2 + m2 c2 g sin a2 = 0,
// solved in extended precision. Two equal rods swing at w^2 = (3 -+ 6/sqrt 7) g/l.
#include "benchmarks/analytic/support/smooth_parts.h"

namespace twinarm {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2;

special::Rates double_pendulum_rates(const ChainLink& one, const ChainLink& two, Real gravity) {
  const Real J1 = Real(one.mass) * one.com * one.com + one.inertia;
  const Real J2 = Real(two.mass) * two.com * two.com + two.inertia;
  const Real distal = Real(two.mass) * one.length;
  const Real A = J1 + distal * one.length, K = distal * two.com;
  const Real G1 = (Real(one.mass) * one.com + distal) * gravity;
  const Real G2 = Real(two.mass) * two.com * gravity;
  return [=](Real, const special::Numbers& x, special::Numbers& dx) {
    const Real d = x[0] - x[1], S = K * std::sin(d);
    const special::Two a = special::solve_two(
        A, K * std::cos(d), J2,
        {-S * x[3] * x[3] - G1 * std::sin(x[0]), S * x[2] * x[2] - G2 * std::sin(x[1])});
    dx = {x[2], x[3], a.first, a.second};
  };
}

const std::vector<std::string> kAnglesAndRates{"angle 1 [rad]", "angle 2 [rad]", "rate 1 [rad/s]",
                                               "rate 2 [rad/s]"};

// Two point masses, angles from the vertical [rad].
template <int degrees1, int degrees2>
TrajectoryCase two_points() {
  static constexpr double a1 = degrees1 * kDegree, a2 = degrees2 * kDegree;
  const ChainLink link = point_link(1, 1);
  return {.scene = fixed(start_at(plane_chain(link, 2), {a1, a2 - a1}, {0, 0})),
          .times = {1, 2, 5, 10},
          .readings = kAnglesAndRates,
          .observe = absolute_angles(),
          .reference = solution_of(double_pendulum_rates(link, link, 9.81L), {a1, a2, 0, 0})};
}

TrajectoryCase two_rods() {
  const ChainLink link = rod_link(1, 1);
  const auto absolute =
      solution_of(double_pendulum_rates(link, link, 9.81L), {kPi / 2, kPi / 2, 0, 0});
  return {.scene = fixed(start_at(plane_chain(link, 2), {kRightAngle, 0}, {0, 0})),
          .times = {1, 2},
          .readings = kAnglesAndRates,
          .observe = joint_state(),
          .reference = [absolute](double t) {
            const CaseReadings x = absolute(t);
            return values(x[0], x[1] - x[0], x[2], x[3] - x[2]);
          }};
}
TrajectoryCase two_rods_until(std::vector<double> times, const Integration& integration) {
  TrajectoryCase c = integrated_by(integration, two_rods());
  c.times = std::move(times);
  return c;
}

TrajectoryCase two_rods_modes() {
  const double part = 6 / std::sqrt(7.0);
  return evaluation(at_rest(plane_chain(rod_link(1, 1), 2)), {"first [rad/s]", "second [rad/s]"},
                    small_frequencies,
                    {std::sqrt((3 - part) * kGravity), std::sqrt((3 + part) * kGravity)},
                    relative_each);
}

// Project Chrono measures angles from +x: absolute angles from -z, minus 90 degrees.
TrajectoryCase two_plates() {
  const ChainLink link{1, 1, 0.5, 1};
  const auto solved = solution_of(double_pendulum_rates(link, link, 10), {kPi / 2, kPi / 2, 0, 0});
  // From absolute angles and rates: angles from x, rates, centre of the second link.
  const auto converted = [](const CaseReadings& a) {
    return values(a[0] - kRightAngle, a[1] - kRightAngle, a[2], a[3],
                  std::sin(a[0]) + std::sin(a[1]) / 2, -std::cos(a[0]) - std::cos(a[1]) / 2);
  };
  return {
      .scene = fixed(
          start_at(plane_chain(std::vector<ChainLink>{link, link}, 10), {kRightAngle, 0}, {0, 0})),
      .times = {1, 2, 5},
      .readings = {"angle 1 [rad]", "angle 2 [rad]", "rate 1 [rad/s]", "rate 2 [rad/s]", "x 2 [m]",
                   "y 2 [m]"},
      .observe = [=](ModelRef model, StateRef x) { return converted(absolute_angles()(model, x)); },
      .reference = [=](double t) { return converted(solved(t)); }};
}

}  // namespace

CaseFamily double_pendulum_cases() {
  return {110,
          {{"C1-90-90", 1e-8, two_points<90, 90>()},
           {"C1-45-30", 1e-8, two_points<45, 30>()},
           {"C2", 1e-8, two_rods()},
           {"C2-10", 1e-4, two_rods_until({5, 10}, rk4_with())},
           {"C2-dopri5", 1e-8, two_rods_until({1, 2, 5}, dopri5_with(1e-13))},
           {"C2-modes", 1e-12, two_rods_modes()},
           {"C10-double", 1e-8, two_plates()}}};
}

}  // namespace twinarm
