// The Phantom Omni (today: Touch): its geometry, and what it can do. docs/understand/phantom_omni.md has the sources.
//
// Six joints: theta1 (waist), theta2 (upper arm) and theta3 (forearm, RELATIVE to the upper arm)
// carry encoders and motors; theta4..theta6 (yaw, pitch, roll of the stylus) are sensed only.
// Device axes: x to the right, y up, z to the user, origin where the published kinematics has it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "solver/spatial/pose.h"

namespace twinarm {

struct OmniParameters {
  double L1 = 0.13335, L2 = 0.13335;      // upper arm, forearm [m]
  double lift = 0.02335, back = 0.16835;  // of the origin: y + lift, z - back [m] (L3, L4)
  // Of the stylus square to the forearm: theta5 = -0.5 then folds it back along the forearm, as a
  // published robot description has it. Assumed [rad].
  double gimbal_pitch = 1.07;
  std::array<double, 6> lower{-0.98, 0.0, -0.81, -2.45, -0.5, -2.58};  // [rad]
  std::array<double, 6> upper{0.98, 1.75, 1.25, 2.45, 1.75, 2.58};
  double peak_force = 3.3, continuous_force = 0.88;  // at the stylus [N]
  double resolution = 0.055e-3;                      // [m]
  double apparent_mass = 0.045;                      // at the stylus [kg]
  double friction = 0.26;                            // largest, when driven back [N]
  double rate = 1000;                                // of the servo loop [Hz]
};

// Joint angles as sensed, theta1..theta6 [rad].
using OmniAngles = std::array<double, 6>;

// Where the stylus' joints meet (the point that forces act at), device axes [m]. With t3 = theta2 +
// theta3 and R = L1 cos theta2 + L2 sin t3:
//   x = -sin theta1 R,  y = L1 sin theta2 - L2 cos t3 + lift,  z = cos theta1 R - back
Vector3 omni_position(const OmniParameters& omni, const OmniAngles& theta);
Vector3 omni_elbow(const OmniParameters& omni, const OmniAngles& theta);

// d position / d (theta1, theta2, theta3), device axes; det J = -L1 L2 R cos theta3. Singular where
// the point is on the waist's axis (R = 0) and where the arm is stretched or folded.
Matrix3 omni_jacobian(const OmniParameters& omni, const OmniAngles& theta);

// The force [N] that the motors' torques [N m] make at the stylus' point, J^-T tau. A motor that
// has no hold there (R below 1 um, a stretched arm) gives no force.
Vector3 omni_force(const OmniParameters& omni, const OmniAngles& theta,
                   const std::array<double, 3>& torque);
// What the motors can do of it: all torques in proportion, so that the force is at most peak_force.
// Torques that are not finite become zero.
std::array<double, 3> omni_limit(const OmniParameters& omni, const OmniAngles& theta,
                                 const std::array<double, 3>& torque);

// Pose of the stylus, device axes: origin as omni_position, z along the stylus from its point to
// its back end. From the forearm: yaw theta4 about the forearm's axis (elbow to stylus), pitch
// theta5 about x, roll theta6 about the stylus. The order is the device's, signs and zeros are
// assumed:
//   R = Ry(-theta1) Rx(-t3) Ry(-theta4) Rx(theta5 - gimbal_pitch) Rz(theta6)
Pose omni_stylus(const OmniParameters& omni, const OmniAngles& theta);

// theta1..theta3 that reach a point; nothing where it is out of reach. Ranges are not looked at.
// Of the two ways to reach it the one with R >= 0, and of the elbow the one with theta3 within
// +-pi/2, as the ranges have it.
std::optional<std::array<double, 3>> omni_inverse(const OmniParameters& omni,
                                                  const Vector3& position);
// theta4..theta6 as well, for a stylus pose: the pitch within pi/2 of gimbal_pitch, which the
// ranges are. Where the stylus lies along the forearm only the sum of yaw and roll is known: yaw is
// then 0.
std::optional<OmniAngles> omni_inverse(const OmniParameters& omni, const Pose& stylus);
// theta1..theta3 within the ranges whose point is nearest to `position`. The position is finite.
std::array<double, 3> omni_nearest(const OmniParameters& omni, const Vector3& position);

// Device axes to the world's (z up): (x, -z, y).
inline Vector3 world_from_device(const Vector3& v) {
  return {v.x(), -v.z(), v.y()};
}
inline Vector3 device_from_world(const Vector3& v) {
  return {v.x(), v.z(), -v.y()};
}

}  // namespace twinarm
