// Numbers of scene.h as Eigen types, for the conversions of the engines.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "benchmarks/scenes/scene.h"

namespace twinarm::bench {

inline Eigen::Vector3d vector3(const Numbers3& v) {
  return Eigen::Vector3d(v.data());
}
inline Eigen::Matrix3d matrix3(const Numbers9& m) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(m.data());
}
inline Eigen::Matrix3d inertia3(const Numbers6& inertia) {
  const auto& [xx, yy, zz, xy, xz, yz] = inertia;
  Eigen::Matrix3d I;
  I << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return I;
}
inline Eigen::Vector3d axis_of(const Body& b) {
  return Eigen::Vector3d::Unit(static_cast<Eigen::Index>(b.axis));
}
inline Eigen::Quaterniond quaternion(const double* q) {
  return {q[0], q[1], q[2], q[3]};
}
inline void write_quaternion(const Eigen::Quaterniond& R, double* q) {
  q[0] = R.w(), q[1] = R.x(), q[2] = R.y(), q[3] = R.z();
}
inline std::size_t index(int body) {
  return static_cast<std::size_t>(body);
}

// A floating base: coordinates, velocities and forces.
struct Base {
  Eigen::Vector3d p;         // of its origin, world
  Eigen::Quaterniond R;      // body axes to world axes
  Eigen::Vector3d w_B, v_W;  // angular velocity, body axes; velocity of the origin, world axes
  Eigen::Vector3d t_B, f_W;  // torque, body axes; force at the origin, world axes

  explicit Base(const Situation& s)
      : p(s.q.data()),
        R(s.q[3], s.q[4], s.q[5], s.q[6]),
        w_B(s.v.data()),
        v_W(s.v.data() + 3),
        t_B(s.tau.data()),
        f_W(s.tau.data() + 3) {}
};

}  // namespace twinarm::bench
