// B6, 1 kg on a spring of 100 N/m. With d = c / 2m, w0^2 = k / m, from x0 at rest:
//   x = exp(-d t) x0 (C + d S),  C = cos(w t), S = sin(w t)/w, w^2 = w0^2 - d^2; hyperbolic
//   functions for w^2 < 0; 1 and t for w = 0.
// Driven by F cos(W t): x = A cos(W t - phi) + a free motion, A (k - m W^2 + i c W) = F e^(i phi).
// Coulomb friction Fc: half swings about -+ Fc / k, each by 2 Fc / k shorter, until |k x| <= Fc at
// a reversal.
#include <complex>

#include "benchmarks/analytic/support/smooth_parts.h"

namespace twinarm {
namespace {

constexpr double kStiffness = 100, kDrive = 8, kForce = 5;

CaseScene oscillator(double x0, double damping, double coulomb, double force) {
  CaseScene scene = not_conserving(start_at(
      one_body(JointType::prismatic, Vector3::UnitX(), {1, Vector3::Zero(), Matrix3::Identity()},
               {0, 0, damping, coulomb, coulomb}),
      {x0}, {0}));
  scene.sources = {joint_effort(
      [force](double t, double x) { return force * std::cos(kDrive * t) - kStiffness * x; })};
  return scene;
}

// x and v from any initial state.
CaseReadings free_motion(double c, double x0, double v0, double t) {
  const double d = c / 2, square = kStiffness - d * d, w = std::sqrt(std::abs(square));
  const double C = square > 0 ? std::cos(w * t) : std::cosh(w * t);
  const double S = square > 0 ? std::sin(w * t) / w : square < 0 ? std::sinh(w * t) / w : t;
  const double fades = std::exp(-d * t), slope = v0 + d * x0;
  return {fades * (x0 * C + slope * S),
          fades * (-d * (x0 * C + slope * S) - square * x0 * S + slope * C)};
}

TrajectoryCase fading(double damping) {
  return {.scene = [damping] { return oscillator(0.1, damping, 0, 0); },
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
  c.scene = [] { return oscillator(0, 2, 0, kForce); };
  c.times = {1, 2, 5};
  c.reference = [](double t) {
    const std::complex<double> a = response(), now = a * std::polar(1.0, kDrive * t);
    const CaseReadings start = free_motion(2, -a.real(), kDrive * a.imag(), t);
    return values(now.real() + start[0], -kDrive * now.imag() + start[1]);
  };
  return c;
}

// After the transient (e^-40): x = A cos(8t - phi), x' = -8 A sin(8t - phi).
TrajectoryCase resonance() {
  TrajectoryCase c = driven();
  c.times = {40};
  c.at_times_only = true;
  c.readings = {"amplitude [m]", "phase lag [rad]"};
  c.observe = [](ModelRef, StateRef x) {
    const std::complex<double> phasor(x.q[0], -x.qd[0] / kDrive);
    const std::complex<double> amplitude = phasor * std::polar(1.0, -kDrive * 40);
    return values(std::abs(amplitude), -std::arg(amplitude));
  };
  c.reference = constantly({std::abs(response()), -std::arg(response())});
  return c;
}

TrajectoryCase reversals() {
  TrajectoryCase c = fading(0);
  c.scene = [] { return oscillator(0.097, 0, 0.5, 0); };
  c.times = {};
  c.readings = {"x [m]"};
  c.observe = observe(coordinate(0));
  c.reference = [](double n) {
    const double sign = std::fmod(n, 2) == 0 ? 1 : -1;
    return values(n * std::numbers::pi / 10, sign * (0.097 - 0.01 * n));
  };
  c.events = {velocity(0), 9, 4};
  return c;
}

TrajectoryCase stick() {
  TrajectoryCase c = fading(0);
  c.scene = [] { return oscillator(0.097, 0, 0.5, 0); };
  c.times = {std::numbers::pi, 3.5, 5};
  c.at_times_only = true;  // not before the first
  c.reference = constantly({-0.003, 0});
  c.mutant = more_inertia;
  return c;
}

}  // namespace

CaseFamily oscillators_cases() {
  return {80,
          {{"B6-light", 1e-8, fading(2)},
           {"B6-critical", 1e-8, fading(20)},
           {"B6-heavy", 1e-8, fading(40)},
           {"B6-driven", 1e-8, driven()},
           {"B6-resonance", 1e-8, resonance()},
           {"B6-friction", 1e-6, reversals()},
           {"B6-stick", 1e-6, stick()}}};
}

}  // namespace twinarm
