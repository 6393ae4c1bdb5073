// Pose of a frame in another one, in Drake's monogram notation.
//
// X_AB is the pose of frame B in frame A: p_AC = X_AB * p_BC. Used outside the passes, which use
// the Pluecker `Transform` of solver/spatial/spatial.h; solver/dynamics/kinematics.h converts.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace twinarm {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

struct Pose {
  Matrix3 R = Matrix3::Identity();  // R_AB: coordinates in B to coordinates in A
  Vector3 p = Vector3::Zero();      // p_AoBo_A: origin of B from the origin of A, axes of A [m]

  // R p_BC + p by columns: the compiler does not inline Eigen's matrix product.
  Vector3 operator*(const Vector3& p_BC) const {
    return R.col(0) * p_BC.x() + R.col(1) * p_BC.y() + R.col(2) * p_BC.z() + p;
  }
  Pose operator*(const Pose& X_BC) const { return {R * X_BC.R, R * X_BC.p + p}; }
  Pose inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

}  // namespace twinarm
