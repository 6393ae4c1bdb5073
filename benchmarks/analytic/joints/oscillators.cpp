// B6, 1 kg on a spring of 100 N/m. With d = c / 2m, w0^2 = k / m, from x0 at rest:
//   x = exp(-d t) x0 (C + d S),  C and S cos(w t) and sin(w t)/w, w^2 = w0^2 - d^2; where that is
//   negative hyperbolic, where it is zero 1 and t.
// Driven by F cos(W t): x = A cos(W t - phi) + a free motion, A (k - m W^2 + i c W) = F e^(i phi).
// Coulomb friction Fc: half swings about -+ Fc / k, each by 2 Fc / k shorter, until |k x| <= Fc at
// a turn.
#include <cmath>
#include <complex>
#include <numbers>

#include "benchmarks/analytic/joints/joint_cases.h"
#include "benchmarks/analytic/support/smooth_parts.h"

namespace twinarm {
namespace {

using namespace smooth_parts;

constexpr double kStiffness = 100, kDrive = 8, kForce = 5;

CaseScene oscillator(double x0, double damping, double coulomb, double force) {
  CaseScene scene = start_at(
      one_body(JointType::prismatic, Vector3::UnitX(), {1, Vector3::Zero(), Matrix3::Identity()},
               {0, 0, damping, coulomb, coulomb}),
      {x0}, {0});
  scene.conserves = false;
  scene.sources = {std::make_shared<JointEffort>(
      [force](double t, double x) { return force * std::cos(kDrive * t) - kStiffness * x; })};
  return scene;
}

// x and v, for any start.
CaseReadings free_motion(double c, double x0, double v0, double t) {
  const double d = c / 2, square = kStiffness - d * d, w = std::sqrt(std::abs(square));
  const double C = square > 0 ? std::cos(w * t) : std::cosh(w * t);
  const double S = square > 0 ? std::sin(w * t) / w : square < 0 ? std::sinh(w * t) / w : t;
  const double fades = std::exp(-d * t), slope = v0 + d * x0;
  return {fades * (x0 * C + slope * S),
          fades * (-d * (x0 * C + slope * S) - square * x0 * S + slope * C)};
}

TrajectoryCase fading(double damping) {
  return {.statement =
              "1 kg on a spring of 100 N/m, damped, from 0.1 m at rest: <p>x = "
              "e<sup>&minus;dt</sup> x<sub>0</sub> (cos wt + d sin wt / w), d = c/2m, "
              "w<sup>2</sup> = k/m &minus; d<sup>2</sup></p>",
          .scene = [damping] { return oscillator(0.1, damping, 0, 0); },
          .times = {0.25, 0.5, 2},
          .readings = {"x [m]", "v [m/s]"},
          .observe = joint_state(),
          .reference = [damping](double t) { return free_motion(damping, 0.1, 0, t); },
          .mutant = more_inertia};
}

std::complex<double> response() {
  return kForce / std::complex<double>(kStiffness - kDrive * kDrive, 2 * kDrive);
}

TrajectoryCase driven() {
  TrajectoryCase c = fading(2);
  c.statement =
      "1 kg, 100 N/m, 2 N s/m, driven by 5 cos 8t N from rest: <p>x = A cos(8t &minus; "
      "&phi;) + what fades</p>";
  c.scene = [] { return oscillator(0, 2, 0, kForce); };
  c.times = {1, 2, 5};
  c.reference = [](double t) {
    const std::complex<double> a = response(), now = a * std::polar(1.0, kDrive * t);
    const CaseReadings start = free_motion(2, -a.real(), kDrive * a.imag(), t);
    return CaseReadings{now.real() + start[0], -kDrive * now.imag() + start[1]};
  };
  return c;
}

// Once the start is forgotten (e^-40): x = A cos(8t - phi), x' = -8 A sin(8t - phi).
TrajectoryCase resonance() {
  TrajectoryCase c = driven();
  c.statement =
      "The same after 40 s: <p>A = F / |k &minus; mW<sup>2</sup> + i c W|, tan &phi; = "
      "cW/(k &minus; mW<sup>2</sup>)</p>";
  c.times = {40};
  c.at_times_only = true;
  c.readings = {"amplitude [m]", "lag [rad]"};
  c.observe = [](const Model<double>&, const State<double>& x) {
    const std::complex<double> turning(x.q[0], -x.qd[0] / kDrive);
    const std::complex<double> amplitude = turning * std::polar(1.0, -kDrive * 40);
    return CaseReadings{std::abs(amplitude), -std::arg(amplitude)};
  };
  c.reference = [](double) { return CaseReadings{std::abs(response()), -std::arg(response())}; };
  return c;
}

TrajectoryCase turns() {
  TrajectoryCase c = fading(0);
  c.statement =
      "1 kg, 100 N/m, 0.5 N of Coulomb friction, from 0.097 m: it turns each &pi;/10 s, at "
      "<p>(&minus;1)<sup>n</sup> (0.097 &minus; 0.01 n) m</p>";
  c.scene = [] { return oscillator(0.097, 0, 0.5, 0); };
  c.times = {};
  c.readings = {"x [m]"};
  c.observe = [](const Model<double>&, const State<double>& x) { return x.q; };
  c.reference = [](double n) {
    const double sign = std::fmod(n, 2) == 0 ? 1 : -1;
    return CaseReadings{n * std::numbers::pi / 10, sign * (0.097 - 0.01 * n)};
  };
  c.events = {[](const Model<double>&, const State<double>& x) { return x.qd[0]; }, 9, 4};
  return c;
}

TrajectoryCase stick() {
  TrajectoryCase c = fading(0);
  c.statement =
      "The same sticks from its tenth turn on: at &minus;0.003 m, after &pi; s, where <p>k |x| "
      "&le; F</p>";
  c.scene = [] { return oscillator(0.097, 0, 0.5, 0); };
  c.times = {std::numbers::pi, 3.5, 5};
  c.at_times_only = true;  // not before the first
  c.reference = [](double) { return CaseReadings{-0.003, 0}; };
  c.mutant = more_inertia;
  return c;
}

}  // namespace

CaseFamily oscillators_cases() {
  const char* group = "joints";
  const std::vector<AnalyticCase> cases = {
      trajectory_case("B6-light", group, "spring, c = 2 N s/m: x [m], v [m/s], 2 s", 1e-8,
                      fading(2)),
      trajectory_case("B6-critical", group, "the same, c = 20 N s/m", 1e-8, fading(20)),
      trajectory_case("B6-heavy", group, "the same, c = 40 N s/m", 1e-8, fading(40)),
      trajectory_case("B6-driven", group, "driven at 8 rad/s from rest: x [m], v [m/s], 5 s", 1e-8,
                      driven()),
      trajectory_case("B6-resonance", group,
                      "the same at last: 0.12691827064170238 m, lag 0.4182243295792291 rad", 1e-8,
                      resonance()),
      trajectory_case("B6-friction", group,
                      "Coulomb friction: nine turns, each pi/10 s and 0.01 m less [s, m]", 1e-6,
                      turns()),
      trajectory_case("B6-stick", group, "the same: at -0.003 m from pi s on [m, m/s]", 1e-6,
                      stick()),
  };
  return {80, cases};
}

}  // namespace twinarm
