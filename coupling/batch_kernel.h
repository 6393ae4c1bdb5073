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

template <class S>
TWINARM_KERNEL void pull_world(BatchWork<S>& b, LanePull<S>& pull, const double* row) {
  const Mat3<S>& E = b.E[pull.body];
  const Vec3<S> phi = turn_between(E, row), w_K = E * spread3<S>(row + 9);
  if (b.has_energy) pull.phi = phi;
  Vec3<S> n = pull.k * phi + pull.b_seen * w_K - pull.kb * b.w.v[pull.body].w;
  if (b.has_bias) n += pull.m_star * b.a_bias[pull.body].w;
  b.w.pA[pull.body].n += -n;
}

template <class S>
TWINARM_KERNEL void pull_linear(BatchWork<S>& b, const LanePull<S>& pull, const double* row) {
  const Motion<S>& v = b.w.v[pull.body];
  const Vec3<S>& p = pull.p_B;
  const Vec3<S> towards =
      pull.k * (spread3<S>(row) - b.o[pull.body]) + pull.b_seen * spread3<S>(row + 3);
  Vec3<S> f = b.E[pull.body] * towards - pull.kp - pull.kb * plus_cross(v.v, v.w, p);
  if (b.has_bias) {
    const Motion<S>& a = b.a_bias[pull.body];
    f += pull.m_star * plus_cross(a.v, a.w, p);
  }
  Force<S>& pA = b.w.pA[pull.body];
  pA.n = minus_cross(pA.n, p, f);
  pA.f = pA.f - f;
}

// A spring for the energies, in body axes; of a joint the first component alone.
template <class S>
struct PullEnds {
  Vec3<S> offset, v_D, v_before, v_after;  // of the target just before and after the moment
};
template <class S>
PullEnds<S> ends_of(const BatchWork<S>& b, const LanePull<S>& pull, const double* row,
                    bool corner) {
  if (pull.kind == PullKind::joint)
    return {{S(row[0]) - b.x.q[pull.iq], S(0), S(0)},
            {b.x.qd[pull.iv], S(0), S(0)},
            {S(row[1]), S(0), S(0)},
            {S(row[2]), S(0), S(0)}};
  const Mat3<S>& E = b.E[pull.body];
  const Motion<S>& v = b.w.v[pull.body];
  const std::size_t velocity = pull.kind == PullKind::world ? 9 : 3;
  const Vec3<S> after = E * spread3<S>(row + velocity + 3);
  const Vec3<S> before = corner ? E * spread3<S>(row + velocity) : after;
  if (pull.kind == PullKind::linear)
    return {E * (spread3<S>(row) - b.o[pull.body]) - pull.p_B, plus_cross(v.v, v.w, pull.p_B),
            before, after};
  // At a corner the step that follows may have another length, or be none.
  return {pull.is_implicit || corner ? turn_between(E, row) : pull.phi, v.w, before, after};
}

template <class S>
struct HandAndWork {
  S hand, counted;
};
// Power of the hand, and of what counts in the ledger. An absolute damper stands on the ground.
template <class S>
HandAndWork<S> powers_of(const LanePull<S>& pull, const PullEnds<S>& e, const Vec3<S>& v_K) {
  const S spring = pull.k * dot(e.offset, v_K), across = dot(e.v_D, v_K);
  const S b_hand = pull.is_absolute ? S(0) : pull.b;
  return {spring + b_hand * (dot(v_K, v_K) - across),
          spring + pull.b_seen * across - pull.b * dot(e.v_D, e.v_D)};
}

// At the moment of step n: half of each power belongs to the step before, half to this one.
template <class S>
TWINARM_KERNEL void add_works(BatchWork<S>& b, std::size_t n) {
  const double* row = b.energy + n * b.energy_stride;
  const bool corner = b.is_corner[n] != 0;
  const S before = S(0.5) * b.h_before, after = n < b.steps ? S(0.5) * b.h : S(0);
  S hand_before = b.hand_work, hand_after(0), work = b.work, held(0);
  for (std::size_t d = 0; b.has_damping && d < b.x.qd.size(); ++d)
    work = work - (before + after) * (b.model.damping[d] * b.x.qd[d] * b.x.qd[d]);
  for (const LanePull<S>& pull : b.pulls) {
    const PullEnds<S> e = ends_of(b, pull, row + pull.energy, corner);
    const HandAndWork<S> now = powers_of(pull, e, e.v_after);
    const HandAndWork<S> was = corner ? powers_of(pull, e, e.v_before) : now;
    work = work + before * was.counted + after * now.counted;
    hand_before = hand_before + before * was.hand;
    hand_after = hand_after + after * now.hand;
    if (corner) held = held + S(0.5) * pull.k * dot(e.offset, e.offset);
  }
  b.work = work;
  b.hand_work_least = select(hand_before < b.hand_work_least, hand_before, b.hand_work_least);
  b.hand_work = hand_before + hand_after;
  if (n == 0) b.spring_energy_at_start = held;
  if (n == b.steps) b.spring_energy = held;
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
    for (LanePull<S>& pull : b.pulls) {
      if (pull.kind == PullKind::world) pull_world(b, pull, row + pull.motion);
      if (pull.kind == PullKind::linear) pull_linear(b, pull, row + pull.motion);
    }
    if (b.has_energy) add_works(b, n);
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
