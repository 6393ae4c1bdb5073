// B1, B2, a point mass on a rod of 1 m, w0^2 = g / l (Landau, Lifshitz, Mechanics, section 11).
//   released at th0:  th = 2 asin(k cd(w0 t, k^2)),  k = sin(th0 / 2),  T = 2 pi / (w0 agm(1, k')),
//   turning over:     th = 2 am(W t / 2, k^2),  k = 2 w0 / W,  W the rate at the bottom; a turn
//                     takes 4 K / W,
//   between the two:  th = 4 atan(exp(w0 t)) - pi.
#include <cmath>
#include <numbers>

#include "benchmarks/analytic/support/reference_math.h"
#include "benchmarks/analytic/support/smooth_parts.h"

namespace twinarm {
namespace {

using namespace smooth_parts;
using Real = long double;

const Real w0 = std::sqrt(Real(9.81L));
constexpr Real kPi = std::numbers::pi_v<Real>;

CaseScene released(double angle, double rate) {
  return start_at(point_pendulum(), {angle}, {rate});
}

Real period(Real amplitude) {
  return 2 * kPi / (w0 * special::arithmetic_geometric_mean(1, std::cos(amplitude / 2)));
}

// The angle passes zero at odd quarters of the period.
template <int degrees>
TrajectoryCase swing_time() {
  constexpr Real amplitude = degrees * kPi / 180;
  return {.scene = [] { return released(static_cast<double>(amplitude), 0); },
          .reference =
              [](double k) {
                static const Real quarter = period(amplitude) / 4;
                return rounded({(2 * Real(k) - 1) * quarter});
              },
          .events = {[](const Model<double>&, const State<double>& x) { return x.q[0]; }, 3, 30}};
}

TrajectoryCase small_swings() {
  return evaluation([] { return released(0, 0); }, {"period [s]"},
                    [](const Model<double>& model, const State<double>& x) {
                      return CaseReadings{2 * std::numbers::pi / small_frequencies(model, x)[0]};
                    },
                    {static_cast<double>(2 * kPi / w0)});
}

TrajectoryCase motion(std::function<CaseScene()> scene, std::vector<double> times,
                      std::function<CaseReadings(double)> reference) {
  return {.scene = std::move(scene),
          .times = std::move(times),
          .readings = {"angle [rad]", "rate [rad/s]"},
          .observe = joint_state(),
          .reference = std::move(reference)};
}

CaseReadings swinging(double t) {
  const Real k2 = 0.5L, k = std::sqrt(k2);
  const special::Jacobi j = special::jacobi(w0 * Real(t), k2);
  return rounded({2 * std::asin(k * j.cn / j.dn), -2 * k * std::sqrt(1 - k2) * w0 * j.sn / j.dn});
}
TrajectoryCase swing() {
  return motion([] { return released(std::numbers::pi / 2, 0); }, {1, 2, 5, 10}, swinging);
}
// The same motion as points of a plane: the benchmark A01 of the IFToMM library.
TrajectoryCase swing_in_plane() {
  TrajectoryCase c = swing();
  c.readings = {"x [m]", "y [m]"};
  c.observe = [](const Model<double>&, const State<double>& x) {
    return CaseReadings{-std::sin(x.q[0]), -std::cos(x.q[0])};
  };
  c.times = {10};
  c.reference = [](double t) {
    const double angle = swinging(t)[0];
    return CaseReadings{-std::sin(angle), -std::cos(angle)};
  };
  return c;
}

constexpr Real kOver = 7;  // W [rad/s]
TrajectoryCase turning() {
  return motion([] { return released(0, double(kOver)); }, {1, 5, 10},
                [](double t) {
                  const Real m = 4 * w0 * w0 / (kOver * kOver), u = kOver * Real(t) / 2;
                  const special::Jacobi j = special::jacobi(u, m);
                  const Real within = std::atan2(j.sn, j.cn);
                  const Real about = u * kPi / (2 * special::quarter_period(m));
                  const Real turns = std::round((about - within) / (2 * kPi));
                  return rounded({2 * (within + 2 * kPi * turns), kOver * j.dn});
                });
}
TrajectoryCase turn_time() {
  return times_of(
      turning(),
      {[](const Model<double>&, const State<double>& x) { return std::sin(x.q[0] / 2); }, 3, 30},
      [](double k) {
        const Real turn = 4 * special::quarter_period(4 * w0 * w0 / (kOver * kOver)) / kOver;
        return rounded({turn * Real(k)});
      });
}

TrajectoryCase separatrix() {
  return motion([] { return released(0, static_cast<double>(2 * w0)); }, {0.25, 0.5, 1},
                [](double t) {
                  const Real u = w0 * Real(t);
                  return rounded({4 * std::atan(std::exp(u)) - kPi, 2 * w0 / std::cosh(u)});
                });
}

}  // namespace

CaseFamily pendulum_cases() {
  return {50,
          {{"B1-1", 1e-9, swing_time<1>()},
           {"B1-10", 1e-9, swing_time<10>()},
           {"B1-45", 1e-9, swing_time<45>()},
           {"B1-90", 1e-9, swing_time<90>()},
           {"B1-120", 1e-9, swing_time<120>()},
           {"B1-150", 1e-9, swing_time<150>()},
           {"B1-170", 1e-9, swing_time<170>()},
           {"B1-179", 1e-9, swing_time<179>()},
           {"B1-small", 1e-12, small_swings()},
           {"B2", 1e-8, swing()},
           {"B2-A01", 1e-8, swing_in_plane()},
           {"B2-over", 1e-8, turning()},
           {"B2-turn", 1e-8, turn_time()},
           {"B2-separatrix", 1e-6, separatrix()}}};
}

}  // namespace twinarm
