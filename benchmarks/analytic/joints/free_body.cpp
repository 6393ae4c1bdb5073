// A free body without torques. A1, symmetric (I1 = I2). The angular momentum H is constant:
//   R(t) = Rot(H / |H|, |H| t / I1) Rot(e3, w3 (I1 - I3) t / I1),   R(0) = 1,
// and w in body axes rotates about e3 at w3 (I3 - I1) / I1.
// Kane, Likins, Levinson, Spacecraft Dynamics (1983), 3.1.
//
// A2, A3, I = diag(1, 2, 3) kg m^2: Euler's equations by Jacobi's elliptic functions (Landau,
// Lifshitz, Mechanics, section 37). With 2T = w.I w and H = |I w|,
//   H^2 > 2T I2:  w = (A1 cn, A2 sn, A3 dn)(n t + u0),
//   H^2 < 2T I2:  w = (A1 dn, A2 sn, A3 cn)(n t + u0).
// Attitude: the axis a of dn, e1 or e3, precesses about H at
//   psi' = H (2T - h_a^2 / I_a) / (H^2 - h_a^2),   h = I w;
// the integral of psi' (of the third kind) and the direction of h give the attitude.
#include "benchmarks/analytic/support/smooth_parts.h"
#include "solver/dynamics/derivatives.h"
#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/world_kinematics.h"

namespace twinarm {
namespace {

CaseScene spinning(const Vector3& moments, const Vector3& w) {
  return start_at(free_body(1, moments), {0, 0, 0, 1, 0, 0, 0}, {w.x(), w.y(), w.z(), 0, 0, 0});
}
TrajectoryCase rotation(CaseScene scene, std::vector<double> times, CaseReference reference) {
  return {.scene = fixed(std::move(scene)),
          .times = std::move(times),
          .readings = {"qw", "qx", "qy", "qz", "w1 [rad/s]", "w2 [rad/s]", "w3 [rad/s]"},
          .observe = observe_attitude_and_rate,
          .reference = std::move(reference),
          .measure = attitude_and_rate_error,
          .mutant = more_inertia};
}

// ---- A1 ----

constexpr double kAcross = 0.04, kAxial = 0.02;
const Vector3 kRate(2, 0, 5);

CaseScene symmetric_body() {
  return spinning({kAcross, kAcross, kAxial}, kRate);
}
CaseReadings symmetric_reference(double t) {
  const Vector3 H(kAcross * kRate.x(), kAcross * kRate.y(), kAxial * kRate.z());
  const double nutation = kRate.z() * (kAcross - kAxial) / kAcross * t;
  const Eigen::Quaterniond attitude(Eigen::AngleAxisd(H.norm() / kAcross * t, H.normalized()) *
                                    Eigen::AngleAxisd(nutation, Vector3::UnitZ()));
  return attitude_and_rate(attitude, Eigen::AngleAxisd(-nutation, Vector3::UnitZ()) * kRate);
}
TrajectoryCase symmetric_motion() {
  return rotation(symmetric_body(), {1, 5, 10}, symmetric_reference);
}

// In one state: kinetic energy, |H|, and the angle between the axis and H.
TrajectoryCase at_start() {
  const double across = kAcross * kRate.x(), along = kAxial * kRate.z();
  TrajectoryCase c = evaluation(
      symmetric_body(), {"kinetic energy [J]", "|H| [N m s]", "angle of e3 to H [rad]"},
      [](ModelRef model, StateRef x) {
        Workspace<double> w(model);
        kinematics(model, x, w);
        const Vec3<double> H = momentum(model, w).n;
        return values(kinetic_energy(model, x), std::sqrt(dot(H, H)),
                      std::atan2(std::hypot(H.x, H.y), H.z));
      },
      {(across * kRate.x() + along * kRate.z()) / 2, std::hypot(across, along),
       std::atan2(across, along)},
      relative_each);
  c.mutant = more_inertia;
  return c;
}

// ---- A2, A3 ----

constexpr Real I[] = {1, 2, 3};

// u0 is 0 for a start on the plane w2 = 0, and the quarter period for one on w_cn = 0.
struct AsymmetricMotion {
  Real H2, T2, A[3], n, m, u0 = 0;  // |H|^2, 2T, amplitudes, rate of u, parameter
  bool is_about_e3;                 // dn belongs to e3

  AsymmetricMotion(Real w1, Real w2, Real w3) {
    const Real w[] = {w1, w2, w3};
    H2 = T2 = 0;
    for (int k = 0; k < 3; ++k) H2 += I[k] * I[k] * w[k] * w[k], T2 += I[k] * w[k] * w[k];
    is_about_e3 = H2 > T2 * I[1];
    const Real from_1 = H2 - T2 * I[0], from_3 = T2 * I[2] - H2;
    A[0] = std::sqrt(from_3 / (I[0] * (I[2] - I[0])));
    A[1] =
        std::sqrt(is_about_e3 ? from_3 / (I[1] * (I[2] - I[1])) : from_1 / (I[1] * (I[1] - I[0])));
    A[2] = std::sqrt(from_1 / (I[2] * (I[2] - I[0])));
    const Real slow = is_about_e3 ? (I[1] - I[0]) * from_3 : (I[2] - I[1]) * from_1;
    const Real fast = is_about_e3 ? (I[2] - I[1]) * from_1 : (I[1] - I[0]) * from_3;
    n = std::sqrt(fast / (I[0] * I[1] * I[2]));
    m = slow / fast;
    if (w2 != 0) u0 = special::quarter_period(m);
  }
  Vector3 rate(Real t) const {
    const special::Jacobi j = special::jacobi(n * t + u0, m);
    const Real w1 = is_about_e3 ? A[0] * j.cn : A[0] * j.dn;
    const Real w3 = is_about_e3 ? A[2] * j.dn : A[2] * j.cn;
    return {static_cast<double>(w1), static_cast<double>(A[1] * j.sn), static_cast<double>(w3)};
  }
  // Axes fixed to H and to the axis of dn, in body axes.
  Matrix3 axes(Real t) const {
    const Vector3 w = rate(t);
    const Vector3 z = Vector3(double(I[0]) * w[0], double(I[1]) * w[1], double(I[2]) * w[2]) /
                      static_cast<double>(std::sqrt(H2));
    const Vector3 a = is_about_e3 ? Vector3::UnitZ() : Vector3::UnitX();
    const Vector3 x = (a - a.dot(z) * z).normalized();
    return (Matrix3() << x, z.cross(x), z).finished();
  }
  Eigen::Quaterniond attitude(Real t) const {
    const Real moment = is_about_e3 ? I[2] : I[0], amplitude = is_about_e3 ? A[2] : A[0];
    const auto precession = [&](Real s) {
      const Real h = moment * amplitude * special::jacobi(n * s + u0, m).dn;
      return std::sqrt(H2) * (T2 - h * h / moment) / (H2 - h * h);
    };
    const auto psi = static_cast<double>(special::integral(precession, 0, t));
    const Matrix3 R = Eigen::AngleAxisd(psi, Vector3::UnitZ()).toRotationMatrix();
    return Eigen::Quaterniond(Matrix3(axes(0) * R * axes(t).transpose()));
  }
  CaseReadings readings(Real t) const { return attitude_and_rate(attitude(t), rate(t)); }
};

CaseScene asymmetric_body(const Vector3& w) {
  return spinning({double(I[0]), double(I[1]), double(I[2])}, w);
}

TrajectoryCase tumbling() {
  static const AsymmetricMotion motion(1, 0, 1);
  return rotation(asymmetric_body({1, 0, 1}), {1, 2, 5, 10},
                  [](double t) { return motion.readings(t); });
}

TrajectoryCase tumbling_invariants() {
  TrajectoryCase c = tumbling();
  c.readings = {"|H| [N m s]", "kinetic energy [J]"};
  c.observe = [](ModelRef model, StateRef x) {
    const Inertia<double>& inertia = model.I[1];
    const Vector3 h(inertia.I.xx * x.qd[0], inertia.I.yy * x.qd[1], inertia.I.zz * x.qd[2]);
    return values(h.norm(), kinetic_energy(model, x));
  };
  c.reference = constantly({std::sqrt(10.0), 2});
  c.integration = dopri5_with(1e-13);
  c.measure = max_difference;
  return c;
}

const AsymmetricMotion& flipping() {
  static const AsymmetricMotion motion(1e-3L, 1, 0);
  return motion;
}
TrajectoryCase flip() {
  return rotation(asymmetric_body({1e-3, 1, 0}), {5, 10, 15, 20, 30},
                  [](double t) { return flipping().readings(t); });
}

// w2 is zero at odd multiples of K / n.
TrajectoryCase flip_time() {
  return times_of(flip(), {velocity(1), 2, 60},
                  [](double k) { return values((2 * k - 1) * flipping().u0 / flipping().n); });
}

// Near a steady spin w2 the other rates grow as exp(n t): n^2 = (I3 - I2) (I2 - I1) / (I1 I3).
TrajectoryCase flip_growth() {
  TrajectoryCase c = evaluation(
      asymmetric_body({0, 1, 0}), {"growth rate [1/s]"},
      [](ModelRef model, StateRef x) {
        const Eigen::MatrixXd d = forward_dynamics_derivatives(model, x, Forces<double>(model)).dqd;
        return values(std::sqrt(d(0, 2) * d(2, 0)));
      },
      {1 / std::sqrt(3.0)});
  c.mutant = more_inertia;
  return c;
}

}  // namespace

CaseFamily free_body_cases() {
  return {10,
          {{"A1", 1e-8, symmetric_motion()},
           {"A1-start", 1e-12, at_start()},
           {"A1-adaptive", 1e-10, integrated_by(dopri5_with(1e-12), symmetric_motion())},
           {"A2", 1e-8, tumbling()},
           {"A2-invariants", 1e-12, tumbling_invariants()},
           {"A3", 1e-8, flip()},
           {"A3-flip", 1e-6, flip_time()},
           {"A3-growth", 1e-12, flip_growth()}}};
}

}  // namespace twinarm
