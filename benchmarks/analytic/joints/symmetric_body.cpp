// A1, a free symmetric body: I1 = I2. With the angular momentum H, which keeps its direction,
//   R(t) = Rot(H / |H|, |H| t / I1) Rot(e3, w3 (I1 - I3) t / I1),   R(0) = 1,
// and the rate in body axes turns about e3 by w3 (I3 - I1) / I1.
// Kane, Likins, Levinson, Spacecraft Dynamics (1983), 3.1.
#include <cmath>

#include "benchmarks/analytic/support/smooth_parts.h"
#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/energy_momentum.h"
#include "solver/dynamics/world_kinematics.h"

namespace twinarm {
namespace {

using namespace smooth_parts;

constexpr double kAcross = 0.04, kAxial = 0.02;
const Vector3 kRate(2, 0, 5);

CaseScene scene() {
  CaseScene s;
  s.model = free_body(1, {kAcross, kAcross, kAxial});
  s.start = State<double>(s.model);
  for (int k = 0; k < 3; ++k) s.start.qd[static_cast<std::size_t>(k)] = kRate[k];
  return s;
}

CaseReadings reference(double t) {
  const Vector3 H(kAcross * kRate.x(), kAcross * kRate.y(), kAxial * kRate.z());
  const double nutation = kRate.z() * (kAcross - kAxial) / kAcross * t;
  const Eigen::Quaterniond attitude(Eigen::AngleAxisd(H.norm() / kAcross * t, H.normalized()) *
                                    Eigen::AngleAxisd(nutation, Vector3::UnitZ()));
  return attitude_and_rate(attitude, Eigen::AngleAxisd(-nutation, Vector3::UnitZ()) * kRate);
}

TrajectoryCase symmetric_motion() {
  return {.scene = scene,
          .times = {1, 5, 10},
          .readings = {"qw", "qx", "qy", "qz", "w1 [rad/s]", "w2 [rad/s]", "w3 [rad/s]"},
          .observe = observe_attitude_and_rate,
          .reference = reference,
          .measure = attitude_and_rate_error,
          .mutant = more_inertia};
}

// In one state: kinetic energy, |H|, and the angle between the axis and H.
TrajectoryCase at_start() {
  const double across = kAcross * kRate.x(), along = kAxial * kRate.z();
  TrajectoryCase c = evaluation(
      scene, {"kinetic energy [J]", "|H| [N m s]", "angle of e3 to H [rad]"},
      [](const Model<double>& model, const State<double>& x) {
        Workspace<double> w(model);
        kinematics(model, x, w);
        const Vec3<double> H = momentum(model, w).n;
        return CaseReadings{kinetic_energy(model, x), std::sqrt(dot(H, H)),
                            std::atan2(std::hypot(H.x, H.y), H.z)};
      },
      {(across * kRate.x() + along * kRate.z()) / 2, std::hypot(across, along),
       std::atan2(across, along)},
      relative_each);
  c.mutant = more_inertia;
  return c;
}

}  // namespace

CaseFamily symmetric_body_cases() {
  TrajectoryCase adaptive = symmetric_motion();
  adaptive.lane = dopri5_lane(1e-12);
  return {10,
          {{"A1", 1e-8, symmetric_motion()},
           {"A1-start", 1e-12, at_start()},
           {"A1-adaptive", 1e-10, adaptive}}};
}

}  // namespace twinarm
