// The springs of a batch, where the bodies are: what they pull with, and their powers.
//
//   world    n   = k phi + b (w_K - w_D) - k h w_D,   phi = log(E_D E_K^T) in body axes
//   linear   f   = k (p_K - p_D) + b (v_K - v_D) - k h v_D, at p_D; all turned into body axes
//   joint    tau = k (q_K - q_D) + b (qd_K - qd_D) - k h qd_D, before the passes
// where h is the look-ahead of the implicit treatment, else 0. What the weightless inertia m* would
// feel at qdd = 0 is handed back (solver/forces/spring.h).
//
// Powers [W] at a moment, e the spring's offset, v_K and v_D the velocities of target and link:
//   of the hand    k e v_K + b v_K (v_K - v_D)
//   that is lost   b (v_K - v_D)^2
// and with an absolute damper, which does not see v_K: k e v_K, and b v_D^2. Products of what the
// target does alone stand in the table.
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
  S hand, lost;
  SpringPowers(const LaneSpring<S>& pull, const S& e_vK, const S& vD_vK, const S& vK_vK,
               const S& vD_vD) {
    const S across = vK_vK - vD_vK;
    hand = pull.k * e_vK + pull.b_seen * across;
    lost = pull.b * vD_vD + pull.b_seen * (across - vD_vK);
  }
  SpringPowers(const LaneSpring<S>& pull, const Vec3<S>& e, const Vec3<S>& v_D, const Vec3<S>& v_K)
      : SpringPowers(pull, dot(e, v_K), dot(v_D, v_K), dot(v_K, v_K), dot(v_D, v_D)) {}
};
template <class S>
void add(BatchWork<S>& b, const SpringPowers<S>& powers) {
  b.hand_power = b.hand_power + powers.hand;
  b.lost_power = b.lost_power + powers.lost;
}

template <class S>
Vec3<S> turn_between(const Mat3<S>& E_D, const double* E_K) {
  const Vec3<S> k0 = spread3<S>(E_K), k1 = spread3<S>(E_K + 3), k2 = spread3<S>(E_K + 6);
  const auto row = [&](const Vec3<S>& d) { return Vec3<S>{dot(d, k0), dot(d, k1), dot(d, k2)}; };
  return rotation_vector(Mat3<S>{row(E_D.r0), row(E_D.r1), row(E_D.r2)});
}
// Of turned bodies, about z; c and s are its cosine and sine.
template <class S>
S turn_between(const Turn<S>& D, const double* E_K) {
  const S c_K(E_K[0]), s_K(E_K[1]), c = D.c * c_K + D.s * s_K, s = D.c * s_K - D.s * c_K;
  const S near = half_angle_over_sine(S(2) - (c + c)) * (s + s);
  const auto is_near = S(0.70715) < c;
  if (!any_lane(~is_near)) return near;
  const S none(0), one(1);
  return select(is_near, near,
                rotation_vector(Mat3<S>{{c, -s, none}, {s, c, none}, {none, none, one}}).z);
}

// `energy`: the spring's row in the table of energies, or null where they are not wanted now.
template <class S>
TWINARM_KERNEL void pull_world(BatchWork<S>& b, const LaneSpring<S>& pull, const double* row,
                               const double* energy) {
  const Mat3<S>& E = b.E[pull.body];
  Vec3<S> phi = turn_between(E, row), w_K = E * spread3<S>(row + 9);
  const Vec3<S> w_D = b.w.v[pull.body].w;
  Vec3<S> n = pull.k * phi + pull.b_seen * w_K - pull.kb * w_D;
  if (b.has_bias) n += pull.m_star * b.a_bias[pull.body].w;
  b.w.pA[pull.body].n += -n;
  if (!energy) return;
  if (pull.sees == SampleTime::end) phi = turn_between(E, energy);
  if (pull.sees != SampleTime::start) w_K = E * spread3<S>(energy + 9);
  add(b, SpringPowers<S>(pull, dot(phi, w_K), dot(w_D, w_K), S(energy[15]), dot(w_D, w_D)));
}

// Of a turned body, whose bias acceleration turns nothing.
template <class S>
TWINARM_KERNEL void pull_turned(BatchWork<S>& b, const LaneSpring<S>& pull, const double* row,
                                const double* energy) {
  const Turn<S> E(b.E[pull.body]);
  const S &w_D = b.w.v[pull.body].w.z, w_K(row[11]);
  S phi = turn_between(E, row);
  S& n = b.w.pA[pull.body].n.z;
  n = n - (pull.k * phi + pull.b_seen * w_K - pull.kb * w_D);
  if (!energy) return;
  if (pull.sees == SampleTime::end) phi = turn_between(E, energy);
  const S w(energy[11]);
  add(b, SpringPowers<S>(pull, phi * w, w_D * w, S(energy[15]), w_D * w_D));
}

// Rotation: Mat3, or Turn.
template <class S, class Rotation>
TWINARM_KERNEL void pull_linear(BatchWork<S>& b, const LaneSpring<S>& pull, const Rotation& E,
                                const double* row, const double* energy) {
  const Motion<S>& v = b.w.v[pull.body];
  const Vec3<S>&p = pull.p_B, &o = b.o[pull.body];
  const Vec3<S> v_D = plus_cross(v.v, v.w, p);
  const Vec3<S> towards = pull.k * (spread3<S>(row) - o) + pull.b_seen * spread3<S>(row + 3);
  Vec3<S> f = E * towards - pull.kp - pull.kb * v_D;
  if (b.has_bias) f += pull.m_star * bias_at(p, E, b.a_bias[pull.body]);
  Force<S>& pA = b.w.pA[pull.body];
  pA.n = minus_cross(pA.n, p, f);
  pA.f = pA.f - f;
  if (!energy) return;
  const Vec3<S> v_W = spread3<S>(energy + 3), v_K = E * v_W;  // e v_K, of which p_K v_K is known
  const S e_vK = S(energy[9]) - dot(o, v_W) - dot(p, v_K);
  add(b, SpringPowers<S>(pull, e_vK, dot(v_D, v_K), S(energy[10]), dot(v_D, v_D)));
}

template <class S>
void pull_at(BatchWork<S>& b, const LaneSpring<S>& pull, const double* row, const double* energy) {
  const bool turned = b.place[pull.body] == Place::turned;
  if (pull.kind == SpringKind::world && turned) pull_turned(b, pull, row, energy);
  if (pull.kind == SpringKind::world && !turned) pull_world(b, pull, row, energy);
  if (pull.kind != SpringKind::linear) return;
  if (turned)
    pull_linear(b, pull, Turn<S>(b.E[pull.body]), row, energy);
  else
    pull_linear(b, pull, b.E[pull.body], row, energy);
}

// At the joints: springs and dampers there, and the joints' own damping.
template <class S>
TWINARM_KERNEL void pull_joints(BatchWork<S>& b, const double* row) {
  for (std::size_t d = 0; d < b.x.qd.size(); ++d)
    b.forces.tau[d] = -(b.model.damping[d] * b.x.qd[d]);
  for (const LaneSpring<S>& pull : b.pulls) {
    if (pull.kind != SpringKind::joint) continue;
    const double* target = row + pull.motion;
    S& tau = b.forces.tau[pull.iv];
    tau = tau + pull.k * (S(target[0]) - b.x.q[pull.iq]) + pull.b_seen * S(target[1]) -
          pull.kb * b.x.qd[pull.iv];
  }
}

}  // namespace twinarm::TWINARM_ISA
