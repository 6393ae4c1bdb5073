// Joint models, RBDA table 4.1: transform XJ(q), motion subspace S, integration on the group.
//
// The model builder turns every body frame so that the joint's axis is its z axis; S is then made
// of unit vectors that the compiler knows (solver/model/motion_subspace.h). All quantities are in
// the axes of the child body, unless a joint says otherwise. A joint of a new type is one struct
// here and its name in the list at the bottom. Each struct states
//   nq, nv            numbers in q and in qd
//   XJ(q)             from the joint's frame in the parent to the child's frame
//   XJ(of_q)          the same by sine and cosine of q, where q is one angle (only if it is hot)
//   S(q)              motion subspace, and S_is_constant
//   vJ, cJ            where they are not S qd and 0: velocity, and apparent derivative of S qd
//   identity(q)       writes the q at which the frames coincide
//   integrate         q exp(shift): shift has nv numbers. `out` may be q
//   dexpinv           d theta/dt where q(t) = q(0) exp(theta(t)): what a Runge-Kutta method needs
//   on
//                     a group (Munthe-Kaas 1998)
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "solver/model/motion_subspace.h"
#include "solver/spatial/rotation.h"

namespace twinarm {

struct NoBias {};  // cJ of a joint whose S is constant in the child's axes
template <class S>
Motion<S> operator+(const Motion<S>& a, NoBias) {
  return a;
}
template <class S>
AcrossZ<S> operator+(const AcrossZ<S>& a, NoBias) {
  return a;
}

// What every joint shares that does not say otherwise: q is a vector, and qd its rate.
template <class S, std::size_t n>
struct VectorJoint {
  static constexpr std::size_t nq = n, nv = n;
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
  static Transform<S> XJ(const S*) { return {}; }
};

// Turns about z.
template <class S>
struct RevoluteJoint : VectorJoint<S, 1>, ConstantSubspace<S, AxisZ> {
  static TurnZ<S> XJ(const S* q) { return TurnZ<S>(q[0]); }
  static TurnZ<S> XJ(const SinCos<S>& of_q) { return TurnZ<S>(of_q); }
};

// Shifts along z.
template <class S>
struct PrismaticJoint : VectorJoint<S, 1>, ConstantSubspace<S, UnitAxes<5>> {
  static Transform<S> XJ(const S* q) { return {Mat3<S>::identity(), {S(0), S(0), q[0]}}; }
};

// Turns about z by q and shifts along it by pitch q.
template <class S>
struct ScrewJoint : VectorJoint<S, 1> {
  S pitch;  // [m/rad]
  static constexpr bool S_is_constant = false;
  Columns<S, 1> subspace(const S*) const { return {{{{{S(0), S(0), S(1)}, {S(0), S(0), pitch}}}}}; }
  static NoBias cJ(const S*, const S*) { return {}; }
  Transform<S> XJ(const S* q) const { return {TurnZ<S>(q[0]).E(), {S(0), S(0), pitch * q[0]}}; }
};

// q = (angle about z, shift along z).
template <class S>
struct CylindricalJoint : VectorJoint<S, 2>, ConstantSubspace<S, UnitAxes<2, 5>> {
  static Transform<S> XJ(const S* q) { return {TurnZ<S>(q[0]).E(), {S(0), S(0), q[1]}}; }
};

// Turns about z, then about the turned y: E = E_y(q2) E_z(q1), S = (E_y z, y).
template <class S>
struct UniversalJoint : VectorJoint<S, 2> {
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
    return {E_y * TurnZ<S>(q[0]).E(), {}};
  }
};

// q = (x, y, angle): position in the parent's x-y plane and angle about z; qd are their rates.
template <class S>
struct PlanarJoint : VectorJoint<S, 3> {
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
  static Transform<S> XJ(const S* q) { return {TurnZ<S>(q[2]).E(), {q[0], q[1], S(0)}}; }
};

// q is the unit quaternion (w, x, y, z) that turns the child's coordinates into the parent's; qd
// the angular velocity.
template <class S>
struct SphericalJoint : ConstantSubspace<S, UnitAxes<0, 1, 2>> {
  static constexpr std::size_t nq = 4, nv = 3;
  static Transform<S> XJ(const S* q) { return {quaternion_E(q), {}}; }
  static void identity(S* q) {
    q[0] = S(1);
    q[1] = q[2] = q[3] = S(0);
  }
  static void integrate(const S* q, const S* shift, S* out) { turn_quaternion(q, shift, out); }
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
  static constexpr bool S_is_constant = false;
  static FreeAxes<S> subspace(const S* q) { return {quaternion_E(q + 3)}; }
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
    turn_quaternion(q + 3, shift, out + 3);
  }
  static VecN<S, 6> dexpinv(const VecN<S, 6>& theta, const VecN<S, 6>& qd) {
    const Vec3<S> rate = dexpinv_so3<S>({theta[0], theta[1], theta[2]}, {qd[0], qd[1], qd[2]});
    return {rate.x, rate.y, rate.z, qd[3], qd[4], qd[5]};
  }
};

// Moved from outside: no degree of freedom. q = (x, y, z; w, x, y, z; vJ; aJ): pose of the child in
// the parent, its velocity (w; v) relative to the parent and the apparent derivative of that, both
// in the child's axes. Simulation::prescribe writes them at every stage; integrate keeps them.
template <class S>
struct PrescribedJoint {
  static constexpr std::size_t nq = 19, nv = 0;
  static constexpr bool S_is_constant = true;
  static NoAxes subspace(const S*) { return {}; }
  static Motion<S> vJ(const S* q) { return {{q[7], q[8], q[9]}, {q[10], q[11], q[12]}}; }
  static Motion<S> cJ(const S* q, const S*) {
    return {{q[13], q[14], q[15]}, {q[16], q[17], q[18]}};
  }
  static Transform<S> XJ(const S* q) { return {quaternion_E(q + 3), {q[0], q[1], q[2]}}; }
  static void identity(S* q) {
    std::fill_n(q, nq, S(0));
    q[3] = S(1);
  }
  static void integrate(const S* q, const S*, S* out) { std::copy_n(q, nq, out); }
  static VecN<S, 0> dexpinv(const VecN<S, 0>&, const VecN<S, 0>&) { return {}; }
};

// vJ = S qd, RBDA (3.34), but for the joint whose motion is given.
template <class Joint, class Subspace, class S>
auto joint_velocity(const Joint& joint, const Subspace& subspace, const S* q, const S* qd) {
  if constexpr (requires { joint.vJ(q); }) {
    return joint.vJ(q);
  } else {
    VecN<S, Joint::nv> rate;
    for (std::size_t k = 0; k < Joint::nv; ++k) rate[k] = qd[k];
    return times(subspace, rate);
  }
}

// XJ(q), with the sine and cosine of q[0] where they were computed ahead
// (solver/spatial/sincos_batch.h).
template <class Joint, class S>
auto joint_transform(const Joint& joint, const S* q, const S* sin, const S* cos) {
  if constexpr (takes_sines_ahead<S> && requires { joint.XJ(SinCos<S>{}); })
    if (std::abs(q[0]) <= kPolynomialRange) return joint.XJ(SinCos<S>{*sin, *cos});
  return joint.XJ(q);
}

// What is listed here exists everywhere: builder, passes, contract tests.
enum class JointType : unsigned char {
  fixed,
  revolute,
  prismatic,
  screw,
  cylindrical,
  universal,
  spherical,
  planar,
  free,
  prescribed
};
inline constexpr std::array all_joint_types{
    JointType::fixed,       JointType::revolute,  JointType::prismatic, JointType::screw,
    JointType::cylindrical, JointType::universal, JointType::spherical, JointType::planar,
    JointType::free,        JointType::prescribed};
inline const char* name_of(JointType type) {
  constexpr std::array names{"fixed",     "revolute",  "prismatic", "screw", "cylindrical",
                             "universal", "spherical", "planar",    "free",  "prescribed"};
  return names[static_cast<std::size_t>(type)];
}

// Calls f with the joint struct of this type: f(RevoluteJoint<S>{}), and so on.
template <class S, class F>
void visit_joint(JointType type, const S& pitch, F&& f) {
  switch (type) {
    case JointType::fixed:
      return f(FixedJoint<S>{});
    case JointType::revolute:
      return f(RevoluteJoint<S>{});
    case JointType::prismatic:
      return f(PrismaticJoint<S>{});
    case JointType::screw:
      return f(ScrewJoint<S>{{}, pitch});
    case JointType::cylindrical:
      return f(CylindricalJoint<S>{});
    case JointType::universal:
      return f(UniversalJoint<S>{});
    case JointType::spherical:
      return f(SphericalJoint<S>{});
    case JointType::planar:
      return f(PlanarJoint<S>{});
    case JointType::free:
      return f(FreeJoint<S>{});
    case JointType::prescribed:
      return f(PrescribedJoint<S>{});
  }
}

}  // namespace twinarm
