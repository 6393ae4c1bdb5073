// B7, a point mass on a rod of 1 m about a fixed point (Landau, Lifshitz, Mechanics, section 14).
// With E = v^2/2 + g z and L = x vy - y vx, for 1 kg:
//   z'^2 = 2 (E - g z)(1 - z^2) - L^2 = 2 g (z - z1)(z2 - z)(z3 - z),
//   z = z1 + (z2 - z1) cd^2(k t, m),  k = sqrt(g (z3 - z1) / 2),  m = (z2 - z1) / (z3 - z1),
// from its highest point; the rate of the azimuth is L / (1 - z^2). About the conical pendulum,
// angle a, W^2 = g / cos a, small oscillations have w^2 = W^2 (1 + 3 cos^2 a).
#include "benchmarks/analytic/support/smooth_parts.h"

namespace twinarm {
namespace {

const Vector3 kRod(0, 0, -1);

// On a spherical joint the rod needs an inertia about its axis, on which the motion does not
// depend, as there is no spin. On a universal joint, x then y, a point mass is enough.
Model<double> on(JointType type) {
  const double about_rod = type == JointType::spherical ? 0.1 : 0;
  return one_body(type, Vector3::UnitX(), {1, kRod, Vector3(0, 0, about_rod).asDiagonal()});
}

// In the x-z plane at an angle `tilt`, circling at `rate`.
CaseScene start(JointType type, double tilt, double rate) {
  const double s = std::sin(tilt), c = std::cos(tilt);
  if (type == JointType::universal) return start_at(on(type), {0, -tilt}, {rate * s / c, 0});
  // Rotated about -y by the tilt; angular velocity in body axes without a component along the rod:
  // w x p = v with v = (0, rate s, 0).
  const Vector3 p(s, 0, -c), w = p.cross(Vector3(0, rate * s, 0));
  const Eigen::Quaterniond R(Eigen::AngleAxisd(-tilt, Vector3::UnitY()));
  const Vector3 w_B = R.inverse() * w;
  return start_at(on(type), {R.w(), R.x(), R.y(), R.z()}, {w_B.x(), w_B.y(), w_B.z()});
}

struct ConeMotion {
  Real g = 9.81L, L;
  special::SquaredCd z;
  ConeMotion(Real tilt, Real rate) {
    const Real s = std::sin(tilt), v2 = rate * rate * s * s;
    const Real z2 = -std::cos(tilt);
    L = rate * s * s;
    const Real E = v2 / 2 + g * z2;
    const Real half = (E / g - z2) / 2, product = (L * L - 2 * E) / (2 * g) / z2;
    const Real z3 = half + std::sqrt(half * half - product), z1 = product / z3;
    z = {z2, z1, std::sqrt(g * (z3 - z1) / 2), (z2 - z1) / (z3 - z1)};
  }
  CaseReadings place(Real t) const {
    const Real height = z.at(t), vz = z.rate(t), r = std::sqrt(1 - height * height);
    const auto azimuth_rate = [this](Real s) {
      const Real at = z.at(s);
      return L / (1 - at * at);
    };
    const Real a = special::integral(azimuth_rate, 0, t), vr = -height * vz / r, va = L / r;
    const Real c = std::cos(a), s = std::sin(a);
    return values(r * c, r * s, height, vr * c - va * s, vr * s + va * c, vz);
  }
};

CaseReadings observe_place(ModelRef model, StateRef x) {
  const Kinematics k = kinematics_at(model, x);
  const Vector3 p = k.position(1, kRod), v = k.velocity(1, p);
  return {p.x(), p.y(), p.z(), v.x(), v.y(), v.z()};
}
double vertical_velocity(ModelRef model, StateRef x) {
  return observe_place(model, x)[5];
}
const ConeMotion& wide() {
  static const ConeMotion motion(std::acos(-1.0L) / 3, 2);
  return motion;
}

TrajectoryCase cone_swing(JointType type) {
  return {.scene = [type] { return start(type, 60 * kDegree, 2); },
          .times = {1, 2, 5},
          .readings = {"x [m]", "y [m]", "z [m]", "vx [m/s]", "vy [m/s]", "vz [m/s]"},
          .observe = observe_place,
          .reference = [](double t) { return wide().place(t); }};
}

// Lowest at half a period, at the initial height after a whole one.
TrajectoryCase cone_bounds() {
  TrajectoryCase c = cone_swing(JointType::spherical);
  c.times = {};
  c.readings = {"x [m]", "y [m]", "z [m]"};
  c.observe = [](ModelRef model, StateRef x) {
    const CaseReadings all = observe_place(model, x);
    return CaseReadings(all.begin(), all.begin() + 3);
  };
  c.reference = [](double n) {
    const Real t = wide().z.half_period() * Real(n);
    const CaseReadings all = wide().place(t);
    return values(t, all[0], all[1], all[2]);
  };
  c.events = {vertical_velocity, 2, 3};
  return c;
}

TrajectoryCase momentum_kept() {
  TrajectoryCase c = cone_swing(JointType::spherical);
  c.readings = {"Lz [N m s]"};
  c.observe = [](ModelRef model, StateRef x) {
    const CaseReadings p = observe_place(model, x);
    // About the vertical, of the point mass.
    return values(model.I[1].m * (p[0] * p[4] - p[1] * p[3]));
  };
  c.reference = constantly({1.5});
  c.integration = dopri5_with(1e-13);
  c.mutant = more_inertia;
  return c;
}

const double kCone = 30 * kDegree, kRound = std::sqrt(kGravity / std::cos(kCone));
constexpr double kDeviation = 1e-5;  // its square is below the tolerance

TrajectoryCase conical() {
  TrajectoryCase c = cone_swing(JointType::spherical);
  c.scene = [] { return start(JointType::spherical, kCone, kRound); };
  c.reference = [](double t) {
    const double r = std::sin(kCone), z = -std::cos(kCone), C = std::cos(kRound * t);
    const double S = std::sin(kRound * t), v = kRound * r;
    return values(r * C, r * S, z, -v * S, v * C, 0);
  };
  return c;
}

// The same angular momentum at a slightly larger angle: oscillates about the cone.
TrajectoryCase near_conical() {
  TrajectoryCase c = conical();
  c.scene = [] {
    const double ratio = std::sin(kCone) / std::sin(kCone + kDeviation);
    return start(JointType::spherical, kCone + kDeviation, kRound * ratio * ratio);
  };
  return times_of(c, {vertical_velocity, 4, 5}, [](double n) {
    const double w = kRound * std::sqrt(1 + 3 * std::cos(kCone) * std::cos(kCone));
    return values(n * std::acos(-1.0) / w);
  });
}

}  // namespace

CaseFamily spherical_pendulum_cases() {
  return {90,
          {{"B7", 1e-8, cone_swing(JointType::spherical)},
           {"B7-universal", 1e-8, cone_swing(JointType::universal)},
           {"B7-bounds", 1e-8, cone_bounds()},
           {"B7-momentum", 1e-11, momentum_kept()},
           {"B7-conical", 1e-8, conical()},
           {"B7-near", 1e-8, near_conical()}}};
}

}  // namespace twinarm
