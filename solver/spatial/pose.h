// Pose: where a frame stands in another one, in Drake's monogram notation.
//
// X_AB places frame B in frame A: a point with coordinates p_BC in B lies at p_AC = X_AB * p_BC in
// A. Used everywhere outside the passes, which have the Pluecker `Transform` of
// solver/spatial/spatial.h; solver/dynamics/kinematics.h is the one bridge between the two.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace twinarm {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

struct Pose {
  Matrix3 R = Matrix3::Identity();  // R_AB: turns coordinates in B into coordinates in A
  Vector3 p = Vector3::Zero();      // p_AoBo_A: origin of B, from the origin of A, in A [m]

  // R p_BC + p by columns: Eigen's product of a matrix is a call that the compiler does not inline.
  Vector3 operator*(const Vector3& p_BC) const {
    return R.col(0) * p_BC.x() + R.col(1) * p_BC.y() + R.col(2) * p_BC.z() + p;
  }
  Pose operator*(const Pose& X_BC) const { return {R * X_BC.R, R * X_BC.p + p}; }
  Pose inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

}  // namespace twinarm
