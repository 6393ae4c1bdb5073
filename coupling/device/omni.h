// Forward and inverse kinematics, geometry and limits of the Phantom Omni (now: Touch). Sources:
// docs/understand/phantom_omni.md.
//
// Six joints: theta1 (waist), theta2 (upper arm) and theta3 (forearm, relative to the upper arm)
// have encoders and motors; theta4..theta6 (yaw, pitch, roll of the stylus) encoders only. Device
// axes: x to the right, y up, z to the user, origin as in the published kinematics.
#pragma once

#include <array>
#include <optional>

#include "solver/spatial/pose.h"

namespace twinarm {

struct OmniParameters {
  double L1 = 0.13335, L2 = 0.13335;      // upper arm, forearm [m]
  double lift = 0.02335, back = 0.16835;  // of the origin: y + lift, z - back [m] (L3, L4)
  // theta5 of the stylus perpendicular to the forearm. Assumed, from a published robot description
  // [rad].
  double gimbal_pitch = 1.07;
  std::array<double, 6> lower{-0.98, 0.0, -0.81, -2.45, -0.5, -2.58};  // [rad]
  std::array<double, 6> upper{0.98, 1.75, 1.25, 2.45, 1.75, 2.58};
  double peak_force = 3.3;       // at the stylus [N]
  double resolution = 0.055e-3;  // [m]
  double apparent_mass = 0.045;  // at the stylus [kg]
  double friction = 0.26;        // maximum backdrive friction [N]
  double rate = 1000;            // of the servo loop [Hz]
};

// Joint angles as sensed, theta1..theta6 [rad].
using OmniAngles = std::array<double, 6>;

// Intersection of the stylus' joint axes, at which forces act, device axes [m]. With t3 = theta2 +
// theta3 and R = L1 cos theta2 + L2 sin t3:
//   x = -sin theta1 R,  y = L1 sin theta2 - L2 cos t3 + lift,  z = cos theta1 R - back
Vector3 omni_position(const OmniParameters& omni, const OmniAngles& theta);
Vector3 omni_elbow(const OmniParameters& omni, const OmniAngles& theta);

// d position / d (theta1, theta2, theta3), device axes; det J = -L1 L2 R cos theta3. Singular on
// the waist's axis (R = 0) and with a stretched or folded arm.
Matrix3 omni_jacobian(const OmniParameters& omni, const OmniAngles& theta);

// Force [N] of motor torques [N m] at the stylus' point, J^-T tau; without the motors at a
// singularity.
Vector3 omni_force(const OmniParameters& omni, const OmniAngles& theta,
                   const std::array<double, 3>& torque);
// Torques scaled so that the force is at most peak_force; zero if not finite.
std::array<double, 3> omni_limit(const OmniParameters& omni, const OmniAngles& theta,
                                 const std::array<double, 3>& torque);

// Pose of the stylus, device axes: origin at omni_position, z from its point to its back end.
// Relative to the forearm: yaw theta4 about the forearm's axis (elbow to stylus), pitch theta5
// about x, roll theta6 about the stylus. Signs and zeros are assumed:
//   R = Ry(-theta1) Rx(-t3) Ry(-theta4) Rx(theta5 - gimbal_pitch) Rz(theta6)
Pose omni_stylus(const OmniParameters& omni, const OmniAngles& theta);

// theta1..theta3 of a point, without ranges; empty if out of reach. The solution with R >= 0 and
// theta3 within +-pi/2.
std::optional<std::array<double, 3>> omni_inverse(const OmniParameters& omni,
                                                  const Vector3& position);
// theta1..theta6 of a stylus pose, pitch within pi/2 of gimbal_pitch. With the stylus along the
// forearm yaw is 0.
std::optional<OmniAngles> omni_inverse(const OmniParameters& omni, const Pose& stylus);
// theta1..theta3 within the ranges that minimise the distance to `position` (finite).
std::array<double, 3> omni_nearest(const OmniParameters& omni, const Vector3& position);

// Device axes to world axes (z up): (x, -z, y).
inline Vector3 world_from_device(const Vector3& v) {
  return {v.x(), -v.z(), v.y()};
}
inline Vector3 device_from_world(const Vector3& v) {
  return {v.x(), v.z(), -v.y()};
}

}  // namespace twinarm
