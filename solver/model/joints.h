// Joint models, RBDA table 4.1: transform XJ(q), motion subspace S, integration on the group.
//
// The model builder turns every body frame so that the joint's axis is its z axis; S is then made
// of unit vectors that the compiler knows (solver/model/motion_subspace.h). All quantities are in
// the axes of the child body, unless a joint says otherwise. A joint of a new type is one struct
// here and its line in the list at the bottom. Each struct states
//   nq, nv            numbers in q and in qd
//   np                numbers in State::prescribed (only if its motion is given)
//   axis              what the axis given to the builder is for
//   quaternion        where in q a unit quaternion begins, whose rates come first in qd; -1: none
//   coordinates       label of each number of q, and whether it is an angle
//   XJ(q)             from the joint's frame in the parent to the child's frame
//   XJ(of_q)          the same by sine and cosine of q, where q is one angle (only if it is hot)
//   S(q)              motion subspace, and S_is_constant
//   vJ, cJ            where they are not S qd and 0: velocity, and apparent derivative of S qd
//   identity(q)       writes the q at which the frames coincide
//   integrate         q exp(shift): shift has nv numbers. `out` may be q
//   dexpinv           d theta/dt where q(t) = q(0) exp(theta(t)): what a Runge-Kutta method on
//                     a group needs (Munthe-Kaas 1998)
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "solver/model/motion_subspace.h"
#include "solver/spatial/rotation.h"

namespace twinarm {

// What the builder's axis is for: nothing; the directions of several axes; or the one axis that the
// joint turns about or slides along.
enum class AxisUse : unsigned char { none, frame, motion };
// One number of q as people have it; the label is empty where the joint has but one.
struct Coordinate {
  const char* label;
  bool is_angle;
};

struct NoBias {};  // cJ of a joint whose S is constant in the child's axes
template <class S>
Motion<S> operator+(const Motion<S>& a, NoBias) {
  return a;
}
template <class S>
MotionNormalToZ<S> operator+(const MotionNormalToZ<S>& a, NoBias) {
  return a;
}

// What every joint shares that does not say otherwise: q is a vector, and qd its rate.
template <class S, std::size_t n>
struct VectorJoint {
  static constexpr std::size_t nq = n, nv = n;
  static constexpr int quaternion = -1;
  static void identity(S* q) { std::fill_n(q, n, S(0)); }
  static void integrate(const S* q, const S* shift, S* out) {
    for (std::size_t k = 0; k < n; ++k) out[k] = q[k] + shift[k];
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

// Turns about z.
template <class S>
struct RevoluteJoint : VectorJoint<S, 1>, ConstantSubspace<S, AxisZ> {
  static constexpr AxisUse axis = AxisUse::motion;
  static constexpr std::array<Coordinate, 1> coordinates{{{"", true}}};
  static RotationZ<S> XJ(const S* q) { return RotationZ<S>(q[0]); }
  static RotationZ<S> XJ(const SinCos<S>& of_q) { return RotationZ<S>(of_q); }
};

// Shifts along z.
template <class S>
struct PrismaticJoint : VectorJoint<S, 1>, ConstantSubspace<S, UnitAxes<5>> {
  static constexpr AxisUse axis = AxisUse::motion;
  static constexpr std::array<Coordinate, 1> coordinates{{{"", false}}};
  static Transform<S> XJ(const S* q) { return {Mat3<S>::identity(), {S(0), S(0), q[0]}}; }
};

// Turns about z by q and shifts along it by pitch q.
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

// q = (angle about z, shift along z).
template <class S>
struct CylindricalJoint : VectorJoint<S, 2>, ConstantSubspace<S, UnitAxes<2, 5>> {
  static constexpr AxisUse axis = AxisUse::motion;
  static constexpr std::array<Coordinate, 2> coordinates{{{"angle", true}, {"shift", false}}};
  static Transform<S> XJ(const S* q) { return {RotationZ<S>(q[0]).E(), {S(0), S(0), q[1]}}; }
};

// Turns about z, then about the turned y: E = E_y(q2) E_z(q1), S = (E_y z, y).
template <class S>
struct UniversalJoint : VectorJoint<S, 2> {
  static constexpr AxisUse axis = AxisUse::frame;
  static constexpr std::array<Coordinate, 2> coordinates{{{"first", true}, {"second", true}}};
  static constexpr bool S_is_constant = false;
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

// q is the unit quaternion (w, x, y, z) that turns the child's coordinates into the parent's; qd
// the angular velocity.
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
  static void integrate(const S* q, const S* shift, S* out) { integrate_quaternion(q, shift, out); }
  static VecN<S, 3> dexpinv(const VecN<S, 3>& theta, const VecN<S, 3>& qd) {
    const Vec3<S> rate = dexpinv_so3<S>({theta[0], theta[1], theta[2]}, {qd[0], qd[1], qd[2]});
    return {rate.x, rate.y, rate.z};
  }
};

// Six degrees of freedom, on R^3 x SO(3). q = (x, y, z; w, x, y, z): origin of the child in the
// parent, and its quaternion. qd = (angular velocity in the child's axes; velocity of the child's
// origin in the PARENT's axes), so that a thrown body's momentum has no error of rotation.
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
  static FreeJointSubspace<S> subspace(const S* q) { return {quaternion_E(q + 3)}; }
  static Motion<S> cJ(const S* q, const S* qd) {  // E' v = -w x E v
    return {{}, cross(quaternion_E(q + 3) * Vec3<S>{qd[3], qd[4], qd[5]}, {qd[0], qd[1], qd[2]})};
  }
  static Transform<S> XJ(const S* q) { return {quaternion_E(q + 3), {q[0], q[1], q[2]}}; }
  static void identity(S* q) {
    std::fill_n(q, nq, S(0));
    q[3] = S(1);
  }
  static void integrate(const S* q, const S* shift, S* out) {
    for (std::size_t k = 0; k < 3; ++k) out[k] = q[k] + shift[3 + k];
    integrate_quaternion(q + 3, shift, out + 3);
  }
  static VecN<S, 6> dexpinv(const VecN<S, 6>& theta, const VecN<S, 6>& qd) {
    const Vec3<S> rate = dexpinv_so3<S>({theta[0], theta[1], theta[2]}, {qd[0], qd[1], qd[2]});
    return {rate.x, rate.y, rate.z, qd[3], qd[4], qd[5]};
  }
};

// Moved from outside: no degree of freedom. q = (x, y, z; w, x, y, z): pose of the child in the
// parent. In the place of qd it takes its numbers of State::prescribed, (vJ; aJ): velocity (w; v)
// relative to the parent and the apparent derivative of that, both in the child's axes.
// Simulation::prescribe writes pose and motion at every stage; integrate keeps the pose.
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

// The list of the joints. What is listed exists everywhere: builder, passes, files, contract tests.
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
