// Joint models, RBDA table 4.1: transform XJ(q), motion subspace S, integration on the group.
//
// The model builder rotates each body frame so that the joint axis is its z axis; the columns of S
// are then unit vectors known at compile time (solver/model/motion_subspace.h). All quantities are
// in child axes unless noted. A new joint type is one struct here and one line in the list at the
// bottom. Members of a struct:
//   nq, nv            sizes of q and qd
//   np                size in State::prescribed (prescribed joint only)
//   axis              use of the axis given to the builder
//   quaternion        index in q of a unit quaternion, whose rates come first in qd; -1: none
//   coordinates       label of each entry of q, and whether it is an angle
//   XJ(q)             transform from the joint's frame in the parent to the child's frame
//   XJ(sincos)        the same from sine and cosine of q (revolute joint only)
//   subspace(q)       motion subspace S, and S_is_constant
//   series            ranges of qd: a joint whose S depends on q is simpler joints in series, from
//                     the parent outwards
//   vJ, cJ            S qd and its apparent derivative S' qd, if not S qd and 0
//   identity(q)       writes the q at which the two frames coincide
//   integrate         out = q exp(delta), delta with nv entries; out may be q
//   dexpinv           d theta/dt for q(t) = q(0) exp(theta(t)), used by Runge-Kutta methods on Lie
//                     groups (Munthe-Kaas 1998)
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "solver/model/motion_subspace.h"
#include "solver/spatial/rotation.h"

namespace twinarm {

// Velocities [first, end) of a joint or of a model.
struct DofRange {
  std::size_t first, end;
};
template <class Joint>
constexpr auto series_of(const Joint&) {
  if constexpr (requires { Joint::series; })
    return Joint::series;
  else
    return std::array{DofRange{0, Joint::nv}};
}

// Use of the builder's axis: none; orientation of the joint frame; axis of rotation or translation.
enum class AxisUse : unsigned char { none, frame, motion };
// One entry of q; the label is empty if the joint has one entry only.
struct Coordinate {
  const char* label;
  bool is_angle;
};

struct NoBias {};  // cJ = 0: S is constant in child axes
template <class S>
Motion<S> operator+(const Motion<S>& a, NoBias) {
  return a;
}
template <class S>
MotionNormalToZ<S> operator+(const MotionNormalToZ<S>& a, NoBias) {
  return a;
}

// Base of joints whose q is a vector with rate qd.
template <class S, std::size_t n>
struct VectorJoint {
  static constexpr std::size_t nq = n, nv = n;
  static constexpr int quaternion = -1;
  static void identity(S* q) { std::fill_n(q, n, S(0)); }
  static void integrate(const S* q, const S* delta, S* out) {
    for (std::size_t k = 0; k < n; ++k) out[k] = q[k] + delta[k];
  }
  static VecN<S, n> dexpinv(const VecN<S, n>&, const VecN<S, n>& qd) { return qd; }
};
template <class S, class Axes>
struct ConstantSubspace {
  static constexpr bool S_is_constant = true;
  static constexpr Axes subspace(const S*) { return {}; }
  static NoBias cJ(const S*, const S*) { return {}; }
};

template <class S>
struct FixedJoint : VectorJoint<S, 0>, ConstantSubspace<S, NoAxes> {
  static constexpr AxisUse axis = AxisUse::none;
  static constexpr std::array<Coordinate, 0> coordinates{};
  static Transform<S> XJ(const S*) { return {}; }
};

// Rotation about z.
template <class S>
struct RevoluteJoint : VectorJoint<S, 1>, ConstantSubspace<S, AxisZ> {
  static constexpr AxisUse axis = AxisUse::motion;
  static constexpr std::array<Coordinate, 1> coordinates{{{"", true}}};
  static RotationZ<S> XJ(const S* q) { return RotationZ<S>(q[0]); }
  static RotationZ<S> XJ(const SinCos<S>& sincos) { return RotationZ<S>(sincos); }
};

// Translation along z.
template <class S>
struct PrismaticJoint : VectorJoint<S, 1>, ConstantSubspace<S, UnitAxes<5>> {
  static constexpr AxisUse axis = AxisUse::motion;
  static constexpr std::array<Coordinate, 1> coordinates{{{"", false}}};
  static Transform<S> XJ(const S* q) { return {Mat3<S>::identity(), {S(0), S(0), q[0]}}; }
};

// Rotation about z by q and translation along z by pitch q.
template <class S>
struct ScrewJoint : VectorJoint<S, 1> {
  static constexpr AxisUse axis = AxisUse::motion;
  static constexpr std::array<Coordinate, 1> coordinates{{{"", true}}};
  S pitch;  // [m/rad]
  static constexpr bool S_is_constant = false;
  Columns<S, 1> subspace(const S*) const { return {{{{{S(0), S(0), S(1)}, {S(0), S(0), pitch}}}}}; }
  static NoBias cJ(const S*, const S*) { return {}; }
  Transform<S> XJ(const S* q) const { return {RotationZ<S>(q[0]).E(), {S(0), S(0), pitch * q[0]}}; }
};

// q = (angle about z, translation along z).
template <class S>
struct CylindricalJoint : VectorJoint<S, 2>, ConstantSubspace<S, UnitAxes<2, 5>> {
  static constexpr AxisUse axis = AxisUse::motion;
  static constexpr std::array<Coordinate, 2> coordinates{{{"angle", true}, {"shift", false}}};
  static Transform<S> XJ(const S* q) { return {RotationZ<S>(q[0]).E(), {S(0), S(0), q[1]}}; }
};

// Rotation about z, then about the rotated y: E = E_y(q2) E_z(q1), S = (E_y z, y).
template <class S>
struct UniversalJoint : VectorJoint<S, 2> {
  static constexpr AxisUse axis = AxisUse::frame;
  static constexpr std::array<Coordinate, 2> coordinates{{{"first", true}, {"second", true}}};
  static constexpr bool S_is_constant = false;
  static constexpr std::array<DofRange, 2> series{{{0, 1}, {1, 2}}};
  static Columns<S, 2> subspace(const S* q) {
    const SinCos<S> b = sin_cos(q[1]);
    return {{{{{-b.sin, S(0), b.cos}, {}}, {{S(0), S(1), S(0)}, {}}}}};
  }
  static Motion<S> cJ(const S* q, const S* qd) {
    const SinCos<S> b = sin_cos(q[1]);
    const S rate = qd[0] * qd[1];
    return {{-(rate * b.cos), S(0), -(rate * b.sin)}, {}};
  }
  static Transform<S> XJ(const S* q) {
    const SinCos<S> b = sin_cos(q[1]);
    const Mat3<S> E_y{{b.cos, S(0), -b.sin}, {S(0), S(1), S(0)}, {b.sin, S(0), b.cos}};
    return {E_y * RotationZ<S>(q[0]).E(), {}};
  }
};

// q = (x, y, angle): position in the parent's x-y plane and angle about z; qd are their rates.
template <class S>
struct PlanarJoint : VectorJoint<S, 3> {
  static constexpr AxisUse axis = AxisUse::frame;
  static constexpr std::array<Coordinate, 3> coordinates{
      {{"x", false}, {"y", false}, {"angle", true}}};
  static constexpr bool S_is_constant = false;
  static constexpr std::array<DofRange, 2> series{{{0, 2}, {2, 3}}};
  static Columns<S, 3> subspace(const S* q) {
    const SinCos<S> a = sin_cos(q[2]);
    return {{{{{}, {a.cos, -a.sin, S(0)}}, {{}, {a.sin, a.cos, S(0)}}, {{S(0), S(0), S(1)}, {}}}}};
  }
  static Motion<S> cJ(const S* q, const S* qd) {  // E'(q) (vx, vy), E' = -[angle' z]x E
    const SinCos<S> a = sin_cos(q[2]);
    const S vx = a.cos * qd[0] + a.sin * qd[1], vy = a.cos * qd[1] - a.sin * qd[0];
    return {{}, {qd[2] * vy, -(qd[2] * vx), S(0)}};
  }
  static Transform<S> XJ(const S* q) { return {RotationZ<S>(q[2]).E(), {q[0], q[1], S(0)}}; }
};

// q: unit quaternion (w, x, y, z) of the child's orientation in the parent; qd: angular velocity.
template <class S>
struct SphericalJoint : ConstantSubspace<S, UnitAxes<0, 1, 2>> {
  static constexpr std::size_t nq = 4, nv = 3;
  static constexpr AxisUse axis = AxisUse::none;
  static constexpr int quaternion = 0;
  static constexpr std::array<Coordinate, 4> coordinates{
      {{"w", true}, {"x", true}, {"y", true}, {"z", true}}};
  static Transform<S> XJ(const S* q) { return {quaternion_E(q), {}}; }
  static void identity(S* q) {
    q[0] = S(1);
    q[1] = q[2] = q[3] = S(0);
  }
  static void integrate(const S* q, const S* delta, S* out) { integrate_quaternion(q, delta, out); }
  static VecN<S, 3> dexpinv(const VecN<S, 3>& theta, const VecN<S, 3>& qd) {
    const Vec3<S> rate = dexpinv_so3<S>({theta[0], theta[1], theta[2]}, {qd[0], qd[1], qd[2]});
    return {rate.x, rate.y, rate.z};
  }
};

// Six degrees of freedom, on R^3 x SO(3). q = (x, y, z; w, x, y, z): origin of the child in the
// parent, and its quaternion. qd = (angular velocity in child axes; velocity of the child's origin
// in PARENT axes): a free body's linear momentum is then integrated without rotation error.
template <class S>
struct FreeJoint {
  static constexpr std::size_t nq = 7, nv = 6;
  static constexpr AxisUse axis = AxisUse::none;
  static constexpr int quaternion = 3;
  static constexpr std::array<Coordinate, 7> coordinates{{{"x", false},
                                                          {"y", false},
                                                          {"z", false},
                                                          {"turn_w", true},
                                                          {"turn_x", true},
                                                          {"turn_y", true},
                                                          {"turn_z", true}}};
  static constexpr bool S_is_constant = false;
  static constexpr std::array<DofRange, 2> series{{{3, 6}, {0, 3}}};
  static FreeJointSubspace<S> subspace(const S* q) { return {quaternion_E(q + 3)}; }
  static Motion<S> cJ(const S* q, const S* qd) {  // E' v = -w x E v
    return {{}, cross(quaternion_E(q + 3) * Vec3<S>{qd[3], qd[4], qd[5]}, {qd[0], qd[1], qd[2]})};
  }
  static Transform<S> XJ(const S* q) { return {quaternion_E(q + 3), {q[0], q[1], q[2]}}; }
  static void identity(S* q) {
    std::fill_n(q, nq, S(0));
    q[3] = S(1);
  }
  static void integrate(const S* q, const S* delta, S* out) {
    for (std::size_t k = 0; k < 3; ++k) out[k] = q[k] + delta[3 + k];
    integrate_quaternion(q + 3, delta, out + 3);
  }
  static VecN<S, 6> dexpinv(const VecN<S, 6>& theta, const VecN<S, 6>& qd) {
    const Vec3<S> rate = dexpinv_so3<S>({theta[0], theta[1], theta[2]}, {qd[0], qd[1], qd[2]});
    return {rate.x, rate.y, rate.z, qd[3], qd[4], qd[5]};
  }
};

// Prescribed motion, no degree of freedom. q = (x, y, z; w, x, y, z): pose of the child in the
// parent. Its entries of State::prescribed replace qd: (vJ; aJ), spatial velocity (w; v) relative
// to the parent and its apparent derivative, both in child axes. IntegrationState writes pose and
// motion at every stage; integrate() keeps the pose.
template <class S>
struct PrescribedJoint {
  static constexpr std::size_t nq = 7, nv = 0, np = 12;
  static constexpr AxisUse axis = AxisUse::none;
  static constexpr int quaternion = 3;
  static constexpr std::array<Coordinate, 0> coordinates{};
  static constexpr bool S_is_constant = true;
  static NoAxes subspace(const S*) { return {}; }
  static Motion<S> vJ(const S* given) {
    return {{given[0], given[1], given[2]}, {given[3], given[4], given[5]}};
  }
  static Motion<S> cJ(const S*, const S* given) { return vJ(given + 6); }
  static Transform<S> XJ(const S* q) { return {quaternion_E(q + 3), {q[0], q[1], q[2]}}; }
  static void identity(S* q) {
    std::fill_n(q, nq, S(0));
    q[3] = S(1);
  }
  static void integrate(const S* q, const S*, S* out) { std::copy_n(q, nq, out); }
  static VecN<S, 0> dexpinv(const VecN<S, 0>&, const VecN<S, 0>&) { return {}; }
};

// List of joint types, used by the builder, the algorithms, the file formats and the joint tests.
#define TWINARM_JOINTS(JOINT)          \
  JOINT(fixed, FixedJoint)             \
  JOINT(revolute, RevoluteJoint)       \
  JOINT(prismatic, PrismaticJoint)     \
  JOINT(screw, ScrewJoint)             \
  JOINT(cylindrical, CylindricalJoint) \
  JOINT(universal, UniversalJoint)     \
  JOINT(spherical, SphericalJoint)     \
  JOINT(planar, PlanarJoint)           \
  JOINT(free, FreeJoint)               \
  JOINT(prescribed, PrescribedJoint)

}  // namespace twinarm
