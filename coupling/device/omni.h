// The Phantom Omni (today: Touch): its geometry, and what it can do. docs/hand.md has the sources.
//
// Six joints: theta1 (waist), theta2 (upper arm) and theta3 (forearm, RELATIVE to the upper arm)
// carry encoders and motors; theta4..theta6 (yaw, pitch, roll of the stylus) are sensed only.
// Device axes: x to the right, y up, z to the user, origin where the published kinematics has it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "solver/pose.h"

namespace twinarm {

struct OmniFigures {
  double L1 = 0.13335, L2 = 0.13335;      // upper arm, forearm [m]
  double lift = 0.02335, back = 0.16835;  // of the origin: y + lift, z - back [m] (L3, L4)
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

// Where the stylus' joints meet (the point that forces act at), device axes [m].
Vector3 omni_position(const OmniFigures& omni, const OmniAngles& theta);

// d position / d (theta1, theta2, theta3), device axes. The motors' torques for a force F at the
// stylus are J^T F. Singular where the point is on the waist's axis and where the arm is stretched.
Matrix3 omni_jacobian(const OmniFigures& omni, const OmniAngles& theta);

// Pose of the stylus, device axes: origin as omni_position.
Pose omni_stylus(const OmniFigures& omni, const OmniAngles& theta);

// theta1..theta3 that reach a point; nothing where it is out of reach. Ranges are not looked at.
std::optional<std::array<double, 3>> omni_inverse(const OmniFigures& omni, const Vector3& position);
// theta4..theta6 as well, for a stylus pose.
std::optional<OmniAngles> omni_inverse(const OmniFigures& omni, const Pose& stylus);

// Device axes to the world's (z up): (x, -z, y).
inline Vector3 world_from_device(const Vector3& v) {
  return {v.x(), -v.z(), v.y()};
}
inline Vector3 device_from_world(const Vector3& v) {
  return {v.x(), v.z(), -v.y()};
}

}  // namespace twinarm
