// A4, a heavy symmetric top on a fixed point: 1 kg, centre 0.2 m from it, I1 = 0.05, I3 = 0.01
// kg m^2 about it, released with its axis at rest, 30 degrees from upright, spin 100 rad/s.
// (Whittaker, Analytical Dynamics, sections 71, 72.) With u = cos(theta), b = 2 m g l / I1,
// a = I3 w3 / I1 and u0 = cos 30:
//   u'^2 = b (u0 - u) (u - u1) (u2 - u),    u1, u2 the roots of b (1 - u^2) = a^2 (u0 - u),
//   u = u1 + (u0 - u1) cd^2(k t, m),        k = sqrt(b (u2 - u1)) / 2,  m = (u0 - u1) / (u2 - u1),
//   phi' = a (u0 - u) / (1 - u^2),  psi' = w3 - phi' u        (precession, spin; z-x-z angles).
#include "benchmarks/analytic/support/smooth_parts.h"
#include "solver/dynamics/derivatives.h"
#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/world_kinematics.h"

namespace twinarm {
namespace {

constexpr double kMoment = 1 * kGravity * 0.2, I1 = 0.05, I3 = 0.01, kTilt = 30 * kDegree;
constexpr double kSpin = 100;

Model<double> top() {
  const Vector3 about_centre(I1 - 0.04, I1 - 0.04, I3);
  return one_body(JointType::spherical, Vector3::UnitZ(),
                  {1, {0, 0, 0.2}, about_centre.asDiagonal()});
}
Eigen::Quaterniond attitude(const State<double>& x) {
  return {x.q[0], x.q[1], x.q[2], x.q[3]};
}
Vector3 rate(const State<double>& x) {
  return {x.qd[0], x.qd[1], x.qd[2]};
}
// Rotated about x by kTilt; rates in body axes.
CaseScene tilted(const Vector3& w) {
  return start_at(top(), {std::cos(kTilt / 2), std::sin(kTilt / 2), 0, 0}, {w.x(), w.y(), w.z()});
}

CaseScene spinning_top() {
  return tilted({0, 0, kSpin});
}

struct Nutation {
  Real u0 = std::sqrt(3.0L) / 2, b = 2 * Real(kMoment) / Real(I1), a = Real(I3) * kSpin / Real(I1);
  special::SquaredCd u;
  Nutation() {
    const Real p = a * a / (2 * b), root = std::sqrt(p * p - 2 * p * u0 + 1);
    const Real u2 = p + root, u1 = (2 * p * u0 - 1) / u2;
    u = {u0, u1, std::sqrt(b * (u2 - u1)) / 2, (u0 - u1) / (u2 - u1)};
  }
  Real precession(Real height) const { return a * (u0 - height) / (1 - height * height); }
  Real azimuth(Real t) const {  // phi
    return special::integral([this](Real s) { return precession(u.at(s)); }, 0, t);
  }
  Real spin_angle(Real t) const {  // psi
    return special::integral(
        [this](Real s) {
          const Real height = u.at(s);
          return kSpin - precession(height) * height;
        },
        0, t);
  }
  Vector3 axis(Real t) const {
    const Real height = u.at(t), s = std::sqrt(1 - height * height), phi = azimuth(t);
    return {double(s * std::sin(phi)), double(-s * std::cos(phi)), double(height)};
  }
  Vector3 rate(Real t) const {
    const Real height = u.at(t), s = std::sqrt(1 - height * height), psi = spin_angle(t);
    const Real along = -u.rate(t) / s, across = precession(height) * s;
    return {double(across * std::sin(psi) + along * std::cos(psi)),
            double(across * std::cos(psi) - along * std::sin(psi)), kSpin};
  }
};
const Nutation& nutation() {
  static const Nutation n;
  return n;
}

CaseReadings observe_axis(ModelRef, StateRef x) {
  return values(Vector3(attitude(x) * Vector3::UnitZ()));
}

TrajectoryCase top_motion(double step) {
  return {.scene = spinning_top,
          .times = {0.1, 0.38054140391335806, 0.5, 1},
          .readings = {"x of the axis", "y of the axis", "z of the axis"},
          .observe = observe_axis,
          .reference = [](double t) { return values(nutation().axis(t)); },
          .integration = rk4_with(step)};
}

// Angular velocity in body axes.
TrajectoryCase rates() {
  TrajectoryCase c = top_motion(1e-4);
  c.readings = {"w1 [rad/s]", "w2 [rad/s]", "w3 [rad/s]"};
  c.observe = [](ModelRef, StateRef x) { return x.qd; };
  c.reference = [](double t) { return values(nutation().rate(t)); };
  return c;
}

// Maximum tilt at half a period, at rest again at a whole one.
TrajectoryCase top_bounds() {
  TrajectoryCase c = top_motion(1e-4);
  c.times = {};
  c.readings = {"tilt [rad]", "azimuth [rad]"};
  c.observe = [](ModelRef model, StateRef x) {
    const CaseReadings e = observe_axis(model, x);
    return values(std::acos(e[2]), std::atan2(e[0], -e[1]));
  };
  c.reference = [](double k) {
    const Nutation& n = nutation();
    const Real t = n.u.half_period() * Real(k);
    return values(t, std::acos(n.u.at(t)), n.azimuth(t));
  };
  c.events = {
      [](ModelRef, StateRef x) { return (attitude(x) * rate(x).cross(Vector3::UnitZ())).z(); }, 2,
      1};
  return c;
}

TrajectoryCase invariants() {
  TrajectoryCase c = top_motion(1e-3);
  c.integration = dopri5_with(1e-12);
  c.readings = {"Lz [N m s]", "w3 [rad/s]"};
  c.observe = [](ModelRef model, StateRef x) {
    Workspace<double> w(model);
    kinematics(model, x, w);
    return values(momentum(model, w).n.z, x.qd[2]);
  };
  c.reference = constantly({I3 * kSpin * std::cos(kTilt), kSpin});
  c.mutant = more_inertia;
  return c;
}

// Meridional acceleration of the axis relative to steady precession at W: quadratic in W, and times
// I1 sin(theta) the left side of I1 cos(theta) W^2 - I3 w3 W + m g l = 0.
double residual(const Model<double>& model, double W) {
  const CaseScene at = tilted({0, 0, 0});
  const Eigen::Quaterniond R = attitude(at.start);
  const Vector3 z = Vector3::UnitZ(), e = R * z;
  const Vector3 w = R.inverse() * (W * z + (kSpin - W * e.z()) * e);
  State<double> x = at.start;
  x.qd = {w.x(), w.y(), w.z()};
  const std::vector<double> qdd = evaluate(model, x).qdd;
  const Vector3 a = R * (Vector3(qdd[0], qdd[1], qdd[2]).cross(z) + w.cross(w.cross(z)));
  return (a - W * W * z.cross(z.cross(e))).dot(Vector3::UnitX().cross(e));
}

TrajectoryCase steady() {
  const auto observe = [](ModelRef model, StateRef) {
    const double C = residual(model, 0), plus = residual(model, 20), minus = residual(model, -20);
    const double A = (plus + minus - 2 * C) / 800, B = (plus - minus) / 40;
    const double fast = (-B + (B < 0 ? 1 : -1) * std::sqrt(B * B - 4 * A * C)) / (2 * A);
    return values(C / (A * fast), fast, kSpin * std::sqrt(4 * A * C) / std::abs(B));
  };
  const double A = I1 * std::cos(kTilt), B = I3 * kSpin, root = B * B - 4 * A * kMoment;
  const double fast = (B + std::sqrt(root)) / (2 * A);
  return evaluation(spinning_top(), {"slow [rad/s]", "fast [rad/s]", "minimum spin [rad/s]"},
                    observe, {kMoment / (A * fast), fast, std::sqrt(4 * A * kMoment) / I3});
}

// Upright, with z = z1 + i z2 the vertical and w = w1 + i w2 the angular velocity, in body axes:
//   z' = -i w3 z + i w,   w' = -i D w - i F z,   D = (1 - I3 / I1) w3,  F = m g l / I1,
// stable for (w3 - D)^2 >= 4 F. F and D are derivatives of the accelerations.
TrajectoryCase sleeping() {
  return evaluation(start_at(top(), {1, 0, 0, 0}, {0, 0, kSpin}), {"minimum spin [rad/s]"},
                    [](ModelRef model, StateRef x) {
                      const auto d = forward_dynamics_derivatives(model, x, Forces<double>(model));
                      return values(2 * std::sqrt(d.dq(0, 0)) / (1 - d.dqd(0, 1) / x.qd[2]));
                    },
                    {2 * std::sqrt(kMoment * I1) / I3});
}

}  // namespace

CaseFamily heavy_top_cases() {
  return {30,
          {{"A4", 1e-5, top_motion(1e-3)},
           {"A4-fine", 1e-9, top_motion(1e-4)},
           {"A4-rates", 1e-8, rates()},
           {"A4-nutation", 1e-6, top_bounds()},
           {"A4-invariants", 1e-10, invariants()},
           {"A4-steady", 1e-12, steady()},
           {"A4-sleeping", 1e-12, sleeping()}}};
}

}  // namespace twinarm
