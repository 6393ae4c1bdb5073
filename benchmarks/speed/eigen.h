// The plain numbers of models.h as Eigen sees them, for the conversions of the engines.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "benchmarks/speed/models.h"

namespace twinarm::speed {

inline Eigen::Vector3d vector3(const Numbers3& v) {
  return Eigen::Vector3d(v.data());
}
inline Eigen::Matrix3d matrix3(const Numbers9& m) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(m.data());
}

// A floating base in one situation: coordinates and velocities, and the forces on it.
struct Base {
  Eigen::Vector3d p;         // of its origin, world
  Eigen::Quaterniond R;      // body axes to world axes
  Eigen::Vector3d v_W, w_B;  // velocity of the origin, world axes; angular velocity, body axes
  Eigen::Vector3d f_W, t_B;  // force at the origin, world axes; torque, body axes

  explicit Base(const Situation& s)
      : p(s.q.data()),
        R(s.q[3], s.q[4], s.q[5], s.q[6]),
        v_W(s.v.data()),
        w_B(s.v.data() + 3),
        f_W(s.tau.data()),
        t_B(s.tau.data() + 3) {}
};

// Entries of the revolute joints alone.
inline std::vector<double> joints_of(const Mechanism& mechanism, const std::vector<double>& all) {
  return {all.end() - static_cast<std::ptrdiff_t>(mechanism.joints()), all.end()};
}

}  // namespace twinarm::speed
