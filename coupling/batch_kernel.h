// The steps of one batch: couplings, forward dynamics, integration and measures, lane by lane.
//
//   qd' = qd + h qdd,   q' = q + h qd'
// Forward dynamics are aba() (solver/aba.h). Between its first pass, which knows where the bodies
// are, and its second, which asks for the forces, the springs pull (LanePulls::moved):
//   world    n   = k phi + b (w_K - w_D) - k h w_D,   phi = log(E_D E_K^T) in body axes
//   linear   f   = k (p_K - p_D) + b (v_K - v_D) - k h v_D, at p_D; all turned into body axes
//   joint    tau = k (q_K - q_D) + b (qd_K - qd_D) - k h qd_D, before the passes
// where h is the look-ahead of the implicit treatment, else 0. What the weightless inertia m* would
// feel at qdd = 0 is handed back (solver/spring.h).
//
// Callers include coupling/batch_run.h.
#pragma once

#include <algorithm>

#include "coupling/batch_work.h"
#include "solver/aba.h"
#include "solver/rotation_log.h"

namespace twinarm::TWINARM_ISA {

template <class S>
Vec3<S> spread3(const double* a) {
  return {S(a[0]), S(a[1]), S(a[2])};
}
template <class S>
S magnitude(const S& x) {
  return select(x < S(0), -x, x);
}
template <class S>
S larger(const S& a, const S& b) {
  return select(a < b, b, a);
}

// What the bodies on the way to the springs' links have, from pass 1. A hinge whose axes at home
// are its parent's turns about z alone, with a third of the products.
template <class S>
TWINARM_KERNEL void place_bodies(BatchWork<S>& b) {
  for (std::size_t i = 1; i < b.E.size(); ++i) {
    if (b.place[i] == Place::none) continue;
    const auto p = static_cast<std::size_t>(b.model.parent[i]);
    const Transform<S>& X = b.w.Xup[i];
    if (p == 0) {
      b.E[i] = X.E, b.o[i] = X.r;
      if (b.has_bias) b.a_bias[i] = X * b.a_bias[0] + b.w.c[i];
      continue;
    }
    const Mat3<S>& E = b.E[p];
    b.o[i] = b.o[p] + transpose_times(E, X.r);
    if (b.place[i] == Place::general) {
      b.E[i] = X.E * E;
      if (b.has_bias) b.a_bias[i] = X * b.a_bias[p] + b.w.c[i];
      continue;
    }
    const S &c = X.E.r0.x, &s = X.E.r0.y;
    b.E[i] = {c * E.r0 + s * E.r1, c * E.r1 - s * E.r0, E.r2};
    if (!b.has_bias) continue;
    const Motion<S>& a = b.a_bias[p];
    const Vec3<S> v = minus_cross(a.v, X.r, a.w);
    b.a_bias[i] = Motion<S>{{c * a.w.x + s * a.w.y, c * a.w.y - s * a.w.x, a.w.z},
                            {c * v.x + s * v.y, c * v.y - s * v.x, v.z}} +
                  b.w.c[i];
  }
}

template <class S>
Vec3<S> turn_between(const Mat3<S>& E_D, const double* E_K) {
  const Vec3<S> k0 = spread3<S>(E_K), k1 = spread3<S>(E_K + 3), k2 = spread3<S>(E_K + 6);
  const auto row = [&](const Vec3<S>& d) { return Vec3<S>{dot(d, k0), dot(d, k1), dot(d, k2)}; };
  return rotation_vector(Mat3<S>{row(E_D.r0), row(E_D.r1), row(E_D.r2)});
}

// What a spring does to the sums of powers [W]: of the hand, and of what counts in the ledger.
// Given the products of its offset, the link's velocity and the target's, each with another.
template <class S>
struct SpringPowers {
  S hand, counted;
  SpringPowers(const LanePull<S>& pull, const S& e_vK, const S& vD_vK, const S& vK_vK,
               const S& vD_vD) {
    const S spring = pull.k * e_vK;
    hand = spring + pull.b_seen * (vK_vK - vD_vK);  // an absolute damper stands on the ground
    counted = spring + pull.b_seen * vD_vK - pull.b * vD_vD;
  }
  SpringPowers(const LanePull<S>& pull, const Vec3<S>& e, const Vec3<S>& v_D, const Vec3<S>& v_K)
      : SpringPowers(pull, dot(e, v_K), dot(v_D, v_K), dot(v_K, v_K), dot(v_D, v_D)) {}
};
template <class S>
void add(BatchWork<S>& b, const SpringPowers<S>& powers) {
  b.hand_power = b.hand_power + powers.hand;
  b.power = b.power + powers.counted;
}

// `energy`: the spring's numbers for the sums of powers, or null where they are not wanted now.
template <class S>
TWINARM_KERNEL void pull_world(BatchWork<S>& b, const LanePull<S>& pull, const double* row,
                               const double* energy) {
  const Mat3<S> E = b.E[pull.body];
  const Vec3<S> phi = turn_between(E, row), w_K = E * spread3<S>(row + 9);
  const Vec3<S> w_D = b.w.v[pull.body].w;
  Vec3<S> n = pull.k * phi + pull.b_seen * w_K - pull.kb * w_D;
  if (b.has_bias) n += pull.m_star * b.a_bias[pull.body].w;
  b.w.pA[pull.body].n += -n;
  if (!energy) return;
  if (pull.sees == Sees::start)
    add(b, SpringPowers<S>(pull, phi, w_D, w_K));
  else
    add(b, SpringPowers<S>(pull, pull.sees == Sees::end ? turn_between(E, energy) : phi, w_D,
                           E * spread3<S>(energy + 12)));
}

template <class S>
TWINARM_KERNEL void pull_linear(BatchWork<S>& b, const LanePull<S>& pull, const double* row,
                                const double* energy) {
  const Mat3<S> E = b.E[pull.body];
  const Motion<S>& v = b.w.v[pull.body];
  const Vec3<S>&p = pull.p_B, &o = b.o[pull.body];
  const Vec3<S> v_D = plus_cross(v.v, v.w, p);
  const Vec3<S> towards = pull.k * (spread3<S>(row) - o) + pull.b_seen * spread3<S>(row + 3);
  Vec3<S> f = E * towards - pull.kp - pull.kb * v_D;
  if (b.has_bias) {
    const Motion<S>& a = b.a_bias[pull.body];
    f += pull.m_star * plus_cross(a.v, a.w, p);
  }
  Force<S>& pA = b.w.pA[pull.body];
  pA.n = minus_cross(pA.n, p, f);
  pA.f = pA.f - f;
  if (energy)
    add(b,
        SpringPowers<S>(pull, E * (spread3<S>(energy) - o) - p, v_D, E * spread3<S>(energy + 6)));
}

// A spring at a corner of the motion, in body axes; of a joint the first component alone.
template <class S>
struct PullEnds {
  Vec3<S> offset, v_D, v_before, v_after;  // of the target just before and after the moment
};
template <class S>
PullEnds<S> ends_of(const BatchWork<S>& b, const LanePull<S>& pull, const double* row) {
  if (pull.kind == PullKind::joint)
    return {{S(row[0]) - b.x.q[pull.iq], S(0), S(0)},
            {b.x.qd[pull.iv], S(0), S(0)},
            {S(row[1]), S(0), S(0)},
            {S(row[2]), S(0), S(0)}};
  const Mat3<S>& E = b.E[pull.body];
  const Motion<S>& v = b.w.v[pull.body];
  const std::size_t velocity = pull.kind == PullKind::world ? 9 : 3;
  const Vec3<S> before = E * spread3<S>(row + velocity), after = E * spread3<S>(row + velocity + 3);
  if (pull.kind == PullKind::linear)
    return {E * (spread3<S>(row) - b.o[pull.body]) - pull.p_B, plus_cross(v.v, v.w, pull.p_B),
            before, after};
  return {turn_between(E, row), v.w, before, after};
}

// The moment of step n: half of each power belongs to the step before, half to this one.
template <class S>
TWINARM_KERNEL void add_works_at_corner(BatchWork<S>& b, std::size_t n) {
  const double* row = b.energy + n * b.energy_stride;
  const S before = S(0.5) * b.h_before, after = n < b.steps ? S(0.5) * b.h : S(0);
  S hand_before = b.hand_work, hand_after(0), held(0);
  b.work = b.work + (before + after) * b.power;  // of the joints' damping
  for (const LanePull<S>& pull : b.pulls) {
    const PullEnds<S> e = ends_of(b, pull, row + pull.energy);
    const SpringPowers<S> was(pull, e.offset, e.v_D, e.v_before),
        is(pull, e.offset, e.v_D, e.v_after);
    b.work = b.work + before * was.counted + after * is.counted;
    hand_before = hand_before + before * was.hand;
    hand_after = hand_after + after * is.hand;
    held = held + S(0.5) * pull.k * dot(e.offset, e.offset);
  }
  b.hand_work_least = select(hand_before < b.hand_work_least, hand_before, b.hand_work_least);
  b.hand_work = hand_before + hand_after;
  if (n == 0) b.spring_energy_at_start = held;
  if (n == b.steps) b.spring_energy = held;
}

// Elsewhere both halves are the same; the springs have added their powers while they pulled.
template <class S>
TWINARM_KERNEL void add_works(BatchWork<S>& b, std::size_t n) {
  const double* row = b.energy + n * b.energy_stride;
  for (const LanePull<S>& pull : b.pulls) {
    if (pull.kind != PullKind::joint) continue;
    const double* target = row + pull.energy;
    const S e = S(target[0]) - b.x.q[pull.iq], v_K(target[2]);
    const S& v_D = b.x.qd[pull.iv];
    add(b, SpringPowers<S>(pull, e * v_K, v_D * v_K, v_K * v_K, v_D * v_D));
  }
  b.work = b.work + b.h * b.power;
  const S half = S(0.5) * b.h * b.hand_power, before = b.hand_work + half;
  b.hand_work_least = select(before < b.hand_work_least, before, b.hand_work_least);
  b.hand_work = before + half;
}

template <class S>
void start_powers(BatchWork<S>& b) {
  b.power = b.hand_power = S(0);
  if (b.has_damping)
    for (std::size_t d = 0; d < b.x.qd.size(); ++d)
      b.power = b.power - b.model.damping[d] * b.x.qd[d] * b.x.qd[d];
}

// The hook of aba(): what acts by where the bodies are.
template <class S>
struct LanePulls {
  BatchWork<S>& b;
  const double* row;
  std::size_t n;
  template <class... T>
  void felt(const T&...) const {}
  void moved() const {
    place_bodies(b);
    const bool smooth = b.has_energy && b.is_corner[n] == 0;
    if (b.has_energy) start_powers(b);
    for (const LanePull<S>& pull : b.pulls) {
      const double* target = row + pull.motion;
      const double* energy = smooth ? b.energy + n * b.energy_stride + pull.energy : nullptr;
      if (pull.kind == PullKind::world) pull_world(b, pull, target, energy);
      if (pull.kind == PullKind::linear) pull_linear(b, pull, target, energy);
    }
    if (smooth)
      add_works(b, n);
    else if (b.has_energy)
      add_works_at_corner(b, n);
    b.model.I = b.model.I_felt.data();
  }
};

// At the joints: springs and dampers there, and the joints' own damping.
template <class S>
TWINARM_KERNEL void pull_joints(BatchWork<S>& b, const double* row) {
  for (std::size_t d = 0; d < b.x.qd.size(); ++d)
    b.forces.tau[d] = -(b.model.damping[d] * b.x.qd[d]);
  for (const LanePull<S>& pull : b.pulls) {
    if (pull.kind != PullKind::joint) continue;
    const double* target = row + pull.motion;
    S& tau = b.forces.tau[pull.iv];
    tau = tau + pull.k * (S(target[0]) - b.x.q[pull.iq]) + pull.b_seen * S(target[1]) -
          pull.kb * b.x.qd[pull.iv];
  }
}

template <class S>
TWINARM_KERNEL void integrate(BatchWork<S>& b) {
  for (std::size_t d = 0; d < b.x.q.size(); ++d) {
    b.x.qd[d] = b.x.qd[d] + b.h * b.w.qdd[d];
    b.x.q[d] = b.x.q[d] + b.h * b.x.qd[d];
  }
}

// Errors after step n; lanes that have left all bounds stop.
template <class S>
TWINARM_KERNEL void measure(BatchWork<S>& b, std::size_t n) {
  const double* q_K = b.q_K + (n + 1) * b.measured.size();
  S sum(0);
  for (std::size_t j = 0; j < b.measured.size(); ++j) {
    const S e = magnitude(S(q_K[j]) - b.x.q[b.measured[j]]);
    sum = sum + e;
    b.error_integral[j] = b.error_integral[j] + b.h * (e + b.error_last[j]);
    b.error_last[j] = e;
    b.window_error_of[j] = larger(b.window_error_of[j], e);
  }
  const auto outside = ~(sum < b.bound);  // NaN too
  if (!any_lane(outside)) return;
  for (std::size_t lane = 0; lane < sizeof(S) / sizeof(double); ++lane)
    if (outside[lane]) b.stopped(b, lane, n + 1);
}

// The quarter's largest errors, by joint and of all, go where the run's are.
template <class S>
void end_window(BatchWork<S>& b, std::size_t window) {
  for (std::size_t j = 0; j < b.measured.size(); ++j) {
    b.error_max[j] = larger(b.error_max[j], b.window_error_of[j]);
    b.window_error[window] = larger(b.window_error[window], b.window_error_of[j]);
    b.window_error_of[j] = S(0);
  }
}

template <class S>
void run_steps(BatchWork<S>& b) {
  std::size_t n = b.first;
  for (std::size_t window = 0; window < b.kWindows; ++window) {
    const std::size_t end = std::min(b.last, (window + 1) * b.steps / b.kWindows);
    for (; n < end && b.lanes_running > 0; ++n) {
      const double* row = b.motion + n * b.motion_stride;
      if (b.has_joint_pulls || b.has_damping) pull_joints(b, row);
      b.model.I = b.model.I_own.data();
      aba(b.model, b.x, b.forces, b.w, LanePulls<S>{b, row, n});
      integrate(b);
      b.h_before = b.h;
      measure(b, n);
    }
    end_window(b, window);
  }
  if (!b.has_energy || b.last < b.steps || b.lanes_running == 0) return;
  b.model.I = b.model.I_own.data();  // the powers at the end; the motion's last row will do
  aba(b.model, b.x, b.forces, b.w,
      LanePulls<S>{b, b.motion + (b.steps - 1) * b.motion_stride, b.steps});
}

}  // namespace twinarm::TWINARM_ISA
