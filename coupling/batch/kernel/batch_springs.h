// Spring forces of a batch, and their powers.
//
//   world    n   = k phi + b (w_K - w_D) - k h w_D,   phi = log(E_D E_K^T) in body axes
//   linear   f   = k (p_K - p_D) + b (v_K - v_D) - k h v_D, at p_D, in body axes
//   joint    tau = k (q_K - q_D) + b (qd_K - qd_D) - k h qd_D, before the passes
// with h: position lead of the implicit discretization, else 0. The bias force of the added inertia
// m* is compensated (solver/forces/spring.h).
//
// Powers [W], e the spring's error, v_K and v_D the velocities of target and link:
//   operator     k e v_K + b v_K (v_K - v_D)
//   dissipated   b (v_K - v_D)^2
// with an absolute damper: k e v_K, and b v_D^2. Products of the target's own numbers are in the
// table.
#pragma once

#include "coupling/batch/kernel/batch_kinematics.h"
#include "solver/spatial/rotation_log.h"

namespace twinarm::TWINARM_ISA {

template <class S>
Vec3<S> spread3(const double* a) {
  return {S(a[0]), S(a[1]), S(a[2])};
}

template <class S>
struct SpringPowers {
  S operator_, dissipated;
  SpringPowers(const LaneSpring<S>& lane_spring, const S& e_vK, const S& vD_vK, const S& vK_vK,
               const S& vD_vD) {
    const S across = vK_vK - vD_vK;
    operator_ = lane_spring.k * e_vK + lane_spring.b_seen * across;
    dissipated = lane_spring.b * vD_vD + lane_spring.b_seen * (across - vD_vK);
  }
  SpringPowers(const LaneSpring<S>& lane_spring, const Vec3<S>& e, const Vec3<S>& v_D,
               const Vec3<S>& v_K)
      : SpringPowers(lane_spring, dot(e, v_K), dot(v_D, v_K), dot(v_K, v_K), dot(v_D, v_D)) {}
};
template <class S>
void add(BatchWork<S>& b, const SpringPowers<S>& powers) {
  b.operator_power = b.operator_power + powers.operator_;
  b.dissipated_power = b.dissipated_power + powers.dissipated;
}

template <class S>
Vec3<S> rotation_between(const Mat3<S>& E_D, const double* E_K) {
  const Vec3<S> k0 = spread3<S>(E_K), k1 = spread3<S>(E_K + 3), k2 = spread3<S>(E_K + 6);
  const auto row = [&](const Vec3<S>& d) { return Vec3<S>{dot(d, k0), dot(d, k1), dot(d, k2)}; };
  return rotation_vector(Mat3<S>{row(E_D.r0), row(E_D.r1), row(E_D.r2)});
}
// Planar bodies: angle about z.
template <class S>
S rotation_between(const RotationAboutZ<S>& D, const double* E_K) {
  const S c_K(E_K[0]), s_K(E_K[1]), c = D.c * c_K + D.s * s_K, s = D.c * s_K - D.s * c_K;
  const S near = half_angle_over_sine(S(2) - (c + c)) * (s + s);
  const auto is_near = S(0.70715) < c;
  if (!any_lane(~is_near)) return near;
  const S none(0), one(1);
  return select(is_near, near,
                rotation_vector(Mat3<S>{{c, -s, none}, {s, c, none}, {none, none, one}}).z);
}

// `energy`: the spring's row in the energy table, or null.
template <class S>
TWINARM_KERNEL void apply_world(BatchWork<S>& b, const LaneSpring<S>& lane_spring,
                                const double* row, const double* energy) {
  const Mat3<S>& E = b.E[lane_spring.body];
  Vec3<S> phi = rotation_between(E, row), w_K = E * spread3<S>(row + 9);
  const Vec3<S> w_D = b.w.v[lane_spring.body].w;
  Vec3<S> n = lane_spring.k * phi + lane_spring.b_seen * w_K - lane_spring.kb * w_D;
  if (b.needs_bias) n += lane_spring.m_star * b.a_bias[lane_spring.body].w;
  b.w.pA[lane_spring.body].n += -n;
  if (!energy) return;
  if (lane_spring.time == SpringTime::end) phi = rotation_between(E, energy);
  if (lane_spring.time != SpringTime::start) w_K = E * spread3<S>(energy + 9);
  add(b, SpringPowers<S>(lane_spring, dot(phi, w_K), dot(w_D, w_K), S(energy[15]), dot(w_D, w_D)));
}

// Planar body: no angular bias acceleration.
template <class S>
TWINARM_KERNEL void apply_planar(BatchWork<S>& b, const LaneSpring<S>& lane_spring,
                                 const double* row, const double* energy) {
  const RotationAboutZ<S> E(b.E[lane_spring.body]);
  const S &w_D = b.w.v[lane_spring.body].w.z, w_K(row[11]);
  S phi = rotation_between(E, row);
  S& n = b.w.pA[lane_spring.body].n.z;
  n = n - (lane_spring.k * phi + lane_spring.b_seen * w_K - lane_spring.kb * w_D);
  if (!energy) return;
  if (lane_spring.time == SpringTime::end) phi = rotation_between(E, energy);
  const S w(energy[11]);
  add(b, SpringPowers<S>(lane_spring, phi * w, w_D * w, S(energy[15]), w_D * w_D));
}

// Rotation: Mat3 or RotationAboutZ.
template <class S, class Rotation>
TWINARM_KERNEL void apply_linear(BatchWork<S>& b, const LaneSpring<S>& lane_spring,
                                 const Rotation& E, const double* row, const double* energy) {
  const Motion<S>& v = b.w.v[lane_spring.body];
  const Vec3<S>&p = lane_spring.p_B, &o = b.o[lane_spring.body];
  const Vec3<S> v_D = plus_cross(v.v, v.w, p);
  const Vec3<S> force_W =
      lane_spring.k * (spread3<S>(row) - o) + lane_spring.b_seen * spread3<S>(row + 3);
  Vec3<S> f = E * force_W - lane_spring.kp - lane_spring.kb * v_D;
  if (b.needs_bias) f += lane_spring.m_star * bias_at(p, E, b.a_bias[lane_spring.body]);
  Force<S>& pA = b.w.pA[lane_spring.body];
  pA.n = minus_cross(pA.n, p, f);
  pA.f = pA.f - f;
  if (!energy) return;
  const Vec3<S> v_W = spread3<S>(energy + 3), v_K = E * v_W;  // e v_K; p_K v_K is in the table
  const S e_vK = S(energy[9]) - dot(o, v_W) - dot(p, v_K);
  add(b, SpringPowers<S>(lane_spring, e_vK, dot(v_D, v_K), S(energy[10]), dot(v_D, v_D)));
}

template <class S>
void apply_spring(BatchWork<S>& b, const LaneSpring<S>& lane_spring, const double* row,
                  const double* energy) {
  const bool planar = b.frames[lane_spring.body] == Frame::planar;
  if (lane_spring.kind == SpringKind::world && planar) apply_planar(b, lane_spring, row, energy);
  if (lane_spring.kind == SpringKind::world && !planar) apply_world(b, lane_spring, row, energy);
  if (lane_spring.kind != SpringKind::linear) return;
  if (planar)
    apply_linear(b, lane_spring, RotationAboutZ<S>(b.E[lane_spring.body]), row, energy);
  else
    apply_linear(b, lane_spring, b.E[lane_spring.body], row, energy);
}

// Joint springs, and joint damping.
template <class S>
TWINARM_KERNEL void apply_joint_springs(BatchWork<S>& b, const double* row) {
  for (std::size_t d = 0; d < b.x.qd.size(); ++d)
    b.forces.tau[d] = -(b.model.damping[d] * b.x.qd[d]);
  for (const LaneSpring<S>& lane_spring : b.springs) {
    if (lane_spring.kind != SpringKind::joint) continue;
    const double* target = row + lane_spring.motion;
    S& tau = b.forces.tau[lane_spring.iv];
    tau = tau + lane_spring.k * (S(target[0]) - b.x.q[lane_spring.iq]) +
          lane_spring.b_seen * S(target[1]) - lane_spring.kb * b.x.qd[lane_spring.iv];
  }
}

}  // namespace twinarm::TWINARM_ISA
