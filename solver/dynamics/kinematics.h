// Forward kinematics: converts the algorithms' Pluecker transforms in body axes to poses,
// velocities and Jacobians in world axes, which are used outside solver/.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "solver/model/workspace.h"
#include "solver/spatial/pose.h"

namespace twinarm {

// Indexed by body, including the base. W: world, L: link frame, B: body frame (Model::R_BL).
struct Kinematics {
  std::vector<Pose> X_WL;              // pose of the link frame
  std::vector<Vector3> w_WL;           // angular velocity of the link, world axes [rad/s]
  std::vector<Vector3> v_WLo;          // velocity of the link's origin, world axes [m/s]
  std::vector<Matrix3> R_WB;           // orientation of the body frame
  std::vector<Motion<double>> a_bias;  // spatial acceleration at qdd = 0, with gravity as
                                       // a_0 = -a_g, body axes (spring.h)
  explicit Kinematics(const Model<double>& model);

  // Position and velocity of a point fixed to the link, p_L from the link's origin in link axes.
  Vector3 position(int body, const Vector3& p_L) const {
    return X_WL[static_cast<std::size_t>(body)] * p_L;
  }
  Vector3 velocity(int body, const Vector3& p_W) const;  // of the link's point currently at p_W

 private:
  friend void forward_kinematics(const Model<double>&, const State<double>&, Kinematics&);
  template <class F>
  friend void for_each_dof_between(const Model<double>&, const Kinematics&, std::size_t, int, F&&);
  BodyKinematics<double> in_body_axes_;
  struct Column {
    Vector3 w, v;
  };
  std::vector<Column> columns_;  // columns of the motion subspaces in world axes, by velocity
};

// Computes all fields of k, O(n).
void forward_kinematics(const Model<double>& model, const State<double>& x, Kinematics& k);
Kinematics kinematics_at(const Model<double>& model, const State<double>& x);  // allocates

// d(velocity of the link's point currently at p_W) / d qd, world axes, 3 x nv.
Eigen::Matrix3Xd point_jacobian(const Model<double>& model, const Kinematics& k, int body,
                                const Vector3& p_W);
// d(angular velocity of the link) / d qd, world axes, 3 x nv.
Eigen::Matrix3Xd rotation_jacobian(const Model<double>& model, const Kinematics& k, int body);

inline Vector3 to_eigen(const Vec3<double>& v) {
  return {v.x, v.y, v.z};
}
inline Vec3<double> from_eigen(const Vector3& v) {
  return {v.x(), v.y(), v.z()};
}
inline Matrix3 to_eigen(const Mat3<double>& A) {
  return (Matrix3() << A.r0.x, A.r0.y, A.r0.z, A.r1.x, A.r1.y, A.r1.z, A.r2.x, A.r2.y, A.r2.z)
      .finished();
}

// Calls f(velocity index, angular part, linear part at the joint's origin, joint's origin) for each
// degree of freedom between the ancestor and the body; world axes. Allocates nothing.
template <class F>
void for_each_dof_between(const Model<double>& model, const Kinematics& k, std::size_t ancestor,
                          int body, F&& f) {
  for (auto i = static_cast<std::size_t>(body); i > ancestor;
       i = static_cast<std::size_t>(model.parent[i])) {
    for (std::size_t dof = model.iv[i]; dof < model.iv[i] + model.dofs(i); ++dof)
      f(dof, k.columns_[dof].w, k.columns_[dof].v, k.X_WL[i].p);
  }
}
// The same between the base and the body.
template <class F>
void for_each_dof_below(const Model<double>& model, const Kinematics& k, int body, F&& f) {
  for_each_dof_between(model, k, 0, body, std::forward<F>(f));
}

}  // namespace twinarm
