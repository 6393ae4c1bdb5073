// Cross-check by definition, in long double: poses of the links from rotations about the axes of
// the builder's input, velocities and accelerations by finite differences of poses along a motion,
// forces by Newton-Euler about each centre of mass. Shares no code with the solver.
#pragma once

#include <array>
#include <cmath>

#include "solver/dynamics/kinematics.h"
#include "solver/model/workspace.h"
#include "tests/solver/dynamics/random_tree.h"

namespace twinarm::testing {

using Real = long double;
using RealVector3 = Eigen::Matrix<Real, 3, 1>;
using RealMatrix3 = Eigen::Matrix<Real, 3, 3>;
using RealVector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

struct RealPose {
  RealMatrix3 R = RealMatrix3::Identity();
  RealVector3 p = RealVector3::Zero();
  RealPose operator*(const RealPose& b) const { return {R * b.R, R * b.p + p}; }
};
inline RealMatrix3 rotation_about(const RealVector3& unit_axis, Real angle) {
  return Eigen::AngleAxis<Real>(angle, unit_axis).toRotationMatrix();
}
inline RealMatrix3 rotation_by(const RealVector3& turn) {
  const Real angle = turn.norm();
  return angle > 0 ? rotation_about(turn / angle, angle) : RealMatrix3::Identity();
}
// Shortest rotation from z to the axis; not for axes along -z.
inline RealMatrix3 from_z_to(const RealVector3& unit_axis) {
  const RealVector3 normal = RealVector3::UnitZ().cross(unit_axis);
  if (normal.norm() == 0) return RealMatrix3::Identity();
  return rotation_about(normal.normalized(), std::atan2(normal.norm(), unit_axis.z()));
}
inline RealMatrix3 of_quaternion(const double* q) {
  return Eigen::Quaternion<Real>(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

// Pose of the link in its joint's frame at q exp(shift); t: time, for prescribed joints.
inline RealPose joint_pose(const TreeBody& body, const double* q, const RealVector& shift, Real t) {
  const RealVector3 a = body.axis.cast<Real>().normalized();
  const auto along = [&](int k) { return q[k] + shift[k]; };
  const auto three = [&](int k) { return RealVector3(q[k], q[k + 1], q[k + 2]); };
  switch (body.type) {
    case JointType::fixed:
      return {};
    case JointType::revolute:
      return {rotation_about(a, along(0)), RealVector3::Zero()};
    case JointType::prismatic:
      return {RealMatrix3::Identity(), along(0) * a};
    case JointType::screw:
      return {rotation_about(a, along(0)), body.properties.pitch * along(0) * a};
    case JointType::cylindrical:
      return {rotation_about(a, along(0)), along(1) * a};
    case JointType::universal:
      return {rotation_about(a, along(0)) *
                  rotation_about(from_z_to(a) * RealVector3::UnitY(), along(1)),
              RealVector3::Zero()};
    case JointType::spherical:
      return {of_quaternion(q) * rotation_by(shift.head<3>()), RealVector3::Zero()};
    case JointType::planar:
      return {rotation_about(a, along(2)), from_z_to(a) * RealVector3(along(0), along(1), 0)};
    case JointType::free:
      return {of_quaternion(q + 3) * rotation_by(shift.head<3>()), three(0) + shift.tail<3>()};
    case JointType::prescribed: {  // any motion with this velocity and this derivative of it
      const RealMatrix3 R = of_quaternion(q + 3);
      const RealVector3 w = three(7), v = three(10), dw = three(13), dv = three(16);
      return {R * rotation_by(t * w + t * t / 2 * dw),
              three(0) + R * (t * v + t * t / 2 * (dv + w.cross(v)))};
    }
  }
  return {};
}

// The links' poses at time t of the motion q exp(t qd + t^2/2 qdd), which has the velocities qd and
// accelerations qdd at t = 0. By body, base included. q as q_with_prescribed() gives it.
inline std::vector<RealPose> link_poses(const std::vector<TreeBody>& bodies,
                                        const Model<double>& model, const std::vector<double>& q,
                                        const std::vector<double>& qd,
                                        const std::vector<double>& qdd, Real t) {
  std::vector<RealPose> X(1);
  for (std::size_t i = 1; i <= bodies.size(); ++i) {
    const TreeBody& b = bodies[i - 1];
    RealVector shift(static_cast<Eigen::Index>(model.dofs(i)));
    for (std::size_t k = 0; k < model.dofs(i); ++k)
      shift[static_cast<Eigen::Index>(k)] =
          t * qd[model.iv[i] + k] + t * t / 2 * qdd[model.iv[i] + k];
    const RealPose X_PJ{b.X_PJ.R.cast<Real>(), b.X_PJ.p.cast<Real>()};
    X.push_back(X[static_cast<std::size_t>(b.parent)] * X_PJ *
                joint_pose(b, q.data() + model.iq[i] + model.ip[i], shift, t));
  }
  return X;
}

// First and second derivative at 0 by central differences of eighth order.
struct Differences {
  static constexpr Real h = 4e-3L;
  static constexpr std::array<Real, 5> first{0, 4 / 5.L, -1 / 5.L, 4 / 105.L, -1 / 280.L};
  static constexpr std::array<Real, 5> second{-205 / 72.L, 8 / 5.L, -1 / 5.L, 8 / 315.L,
                                              -1 / 560.L};
};
template <class Value, class F>
void differentiate(F&& at, Value& d1, Value& d2) {
  d1 = 0 * at(0.0L);
  d2 = Differences::second[0] / (Differences::h * Differences::h) * at(0.0L);
  for (std::size_t k = 1; k <= 4; ++k) {
    const Real t = static_cast<Real>(k) * Differences::h;
    const Value plus = at(t), minus = at(-t);
    d1 += Differences::first[k] / Differences::h * (plus - minus);
    d2 += Differences::second[k] / (Differences::h * Differences::h) * (plus + minus);
  }
}

// One link in the world.
struct LinkMotion {
  RealPose X;
  RealVector3 w, alpha, v, a;  // v, a: of the link's origin
  RealVector3 velocity_of(const RealVector3& r_W) const { return v + w.cross(r_W); }
  RealVector3 acceleration_of(const RealVector3& r_W) const {
    return a + alpha.cross(r_W) + w.cross(w.cross(r_W));
  }
};
inline std::vector<LinkMotion> link_motions(const std::vector<TreeBody>& bodies,
                                            const Model<double>& model,
                                            const std::vector<double>& q,
                                            const std::vector<double>& qd,
                                            const std::vector<double>& qdd) {
  std::array<std::vector<RealPose>, 9> samples;
  for (int k = -4; k <= 4; ++k)
    samples[static_cast<std::size_t>(k + 4)] =
        link_poses(bodies, model, q, qd, qdd, static_cast<Real>(k) * Differences::h);
  const auto sample = [&](Real t, std::size_t i) {
    return samples[static_cast<std::size_t>(std::lround(t / Differences::h) + 4)][i];
  };
  std::vector<LinkMotion> links;
  for (std::size_t i = 0; i <= bodies.size(); ++i) {
    LinkMotion link;
    link.X = sample(0, i);
    differentiate([&](Real t) -> RealVector3 { return sample(t, i).p; }, link.v, link.a);
    RealMatrix3 dR, ddR;
    differentiate([&](Real t) -> RealMatrix3 { return sample(t, i).R; }, dR, ddR);
    const auto axial = [](const RealMatrix3& A) -> RealVector3 {  // of the skew part
      return RealVector3(A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1)) / 2;
    };
    link.w = axial(dR * link.X.R.transpose());
    link.alpha = axial(ddR * link.X.R.transpose());  // R'' R^T = [alpha]x + [w]x [w]x
    links.push_back(link);
  }
  return links;
}

// Velocities of the links per unit of each velocity: (angular, linear of the origin).
inline std::vector<std::vector<LinkMotion>> unit_motions(std::vector<TreeBody> bodies,
                                                         const Model<double>& model,
                                                         std::vector<double> q) {
  for (std::size_t i = 1; i <= bodies.size(); ++i)  // prescribed joints at rest
    if (bodies[i - 1].type == JointType::prescribed)
      std::fill_n(&q[model.iq[i] + model.ip[i] + 7], 12, 0.0);
  std::vector<std::vector<LinkMotion>> by_dof;
  for (std::size_t k = 0; k < model.nv; ++k) {
    std::vector<double> e(model.nv);
    e[k] = 1;
    by_dof.push_back(link_motions(bodies, model, q, e, std::vector<double>(model.nv)));
  }
  return by_dof;
}

inline RealVector3 real(const Vec3<double>& a) {
  return {a.x, a.y, a.z};
}
inline RealMatrix3 real(const Mat3<double>& A) {
  return to_eigen(A).cast<Real>();
}
inline double length_of(const RealVector3& difference) {
  return static_cast<double>(difference.norm());
}
inline std::vector<double> random_numbers(Random& random, std::size_t n, double largest) {
  std::vector<double> all(n);
  for (double& x : all) x = random.uniform(-largest, largest);
  return all;
}

// A random moving tree, with the results of the cross-check.
struct MovingTree {
  std::vector<TreeBody> bodies;
  Model<double> model;
  State<double> x;
  std::vector<double> qdd;
  std::vector<LinkMotion> links;
  Workspace<double> w;
  MovingTree(Random& random, int n, const std::vector<JointType>& types)
      : bodies(random_bodies(random, n, types)),
        model(build(bodies, random.vector(10))),
        x(random_state(random, model)),
        qdd(random_numbers(random, model.nv, 2)),
        links(link_motions(bodies, model, q_with_prescribed(model, x), x.qd, qdd)),
        w(model) {}
};

}  // namespace twinarm::testing
