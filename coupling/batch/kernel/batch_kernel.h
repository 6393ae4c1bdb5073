// The steps of one batch: couplings, forward dynamics, integration and measures, lane by lane.
//
//   qd' = qd + h qdd,   q' = q + h qd'
// Forward dynamics: aba() (solver/passes/aba.h), with spring forces (batch_springs.h) computed
// between its first and second pass. Work is the integral of power by the trapezoidal rule; at a
// jump of a target's velocity or of the step size the two halves differ.
//
// Callers include coupling/batch/batch_run.h.
#pragma once

#include "coupling/batch/kernel/batch_springs.h"
#include "solver/passes/aba.h"

namespace twinarm::TWINARM_ISA {

template <class S>
S magnitude(const S& x) {
  return select(x < S(0), -x, x);
}
template <class S>
S larger(const S& a, const S& b) {
  return select(a < b, b, a);
}

// A spring at a velocity jump, in body axes; joint: first component.
template <class S>
struct SpringEnds {
  Vec3<S> offset, v_D, v_before, v_after;  // of the target before and after the jump
};
template <class S>
SpringEnds<S> spring_ends(const BatchWork<S>& b, const LaneSpring<S>& lane_spring,
                          const double* row) {
  if (lane_spring.kind == SpringKind::joint)
    return {{S(row[0]) - b.x.q[lane_spring.iq], S(0), S(0)},
            {b.x.qd[lane_spring.iv], S(0), S(0)},
            {S(row[1]), S(0), S(0)},
            {S(row[2]), S(0), S(0)}};
  const Mat3<S>& E = b.E[lane_spring.body];
  const Motion<S>& v = b.w.v[lane_spring.body];
  const std::size_t velocity = lane_spring.kind == SpringKind::world ? 9 : 3;
  const Vec3<S> before = E * spread3<S>(row + velocity), after = E * spread3<S>(row + velocity + 3);
  if (lane_spring.kind == SpringKind::linear)
    return {E * (spread3<S>(row) - b.o[lane_spring.body]) - lane_spring.p_B,
            plus_cross(v.v, v.w, lane_spring.p_B), before, after};
  return {rotation_between(E, row), v.w, before, after};
}

// Time of step n: half of each power belongs to the step before, half to this one.
template <class S>
TWINARM_KERNEL void add_work_at_jump(BatchWork<S>& b, std::size_t n) {
  const double* row = b.tables.energy.data() + n * b.tables.energy_stride;
  const S before = S(0.5) * b.h_before, after = n < b.tables.steps ? S(0.5) * b.h : S(0);
  S input_before = b.input_work, input_after(0), held(0);
  b.dissipated_work = b.dissipated_work + (before + after) * b.dissipated_power;  // in the joints
  for (const LaneSpring<S>& lane_spring : b.springs) {
    const SpringEnds<S> e = spring_ends(b, lane_spring, row + lane_spring.energy);
    const SpringPowers<S> was(lane_spring, e.offset, e.v_D, e.v_before),
        is(lane_spring, e.offset, e.v_D, e.v_after);
    b.dissipated_work = b.dissipated_work + before * was.dissipated + after * is.dissipated;
    input_before = input_before + before * was.operator_;
    input_after = input_after + after * is.operator_;
    held = held + S(0.5) * lane_spring.k * dot(e.offset, e.offset);
  }
  b.input_work_min = select(input_before < b.input_work_min, input_before, b.input_work_min);
  b.input_work = input_before + input_after;
  if (n == 0) b.spring_energy_at_start = held;
  if (n == b.tables.steps) b.spring_energy = held;
}

// Without a jump both halves are equal; springs at links have already added their powers.
template <class S>
TWINARM_KERNEL void add_work(BatchWork<S>& b, std::size_t n) {
  const double* row = b.tables.energy.data() + n * b.tables.energy_stride;
  for (const LaneSpring<S>& lane_spring : b.springs) {
    if (lane_spring.kind != SpringKind::joint) continue;
    const double* target = row + lane_spring.energy;
    const S e = S(target[0]) - b.x.q[lane_spring.iq], v_K(target[2]);
    const S& v_D = b.x.qd[lane_spring.iv];
    add(b, SpringPowers<S>(lane_spring, e * v_K, v_D * v_K, v_K * v_K, v_D * v_D));
  }
  b.dissipated_work = b.dissipated_work + b.h * b.dissipated_power;
  const S half = S(0.5) * b.h * b.operator_power, before = b.input_work + half;
  b.input_work_min = select(before < b.input_work_min, before, b.input_work_min);
  b.input_work = before + half;
}

template <class S>
void start_powers(BatchWork<S>& b) {
  b.dissipated_power = b.operator_power = S(0);
  if (b.has_damping)
    for (std::size_t d = 0; d < b.x.qd.size(); ++d)
      b.dissipated_power = b.dissipated_power + b.model.damping[d] * b.x.qd[d] * b.x.qd[d];
}

// Hook of aba() between its first and second pass.
template <class S>
struct LaneSprings {
  BatchWork<S>& b;
  const double* row;
  std::size_t n;
  template <class... T>
  void transmitted(const T&...) const {}
  void after_pass_1() const {
    if (b.needs_rotations) update_rotations(b);
    if (b.needs_bias) update_bias(b);
    const bool smooth = b.tables.is_velocity_jump[n] == 0;
    start_powers(b);
    for (const LaneSpring<S>& lane_spring : b.springs)
      apply_spring(b, lane_spring, row + lane_spring.motion,
                   smooth ? b.tables.energy.data() + n * b.tables.energy_stride + lane_spring.energy
                          : nullptr);
    if (smooth)
      add_work(b, n);
    else
      add_work_at_jump(b, n);
    b.model.I = b.model.I_effective.data();
  }
};

template <class S>
TWINARM_KERNEL void integrate(BatchWork<S>& b) {
  for (std::size_t d = 0; d < b.x.q.size(); ++d) {
    b.x.qd[d] = b.x.qd[d] + b.h * b.w.qdd[d];
    b.x.q[d] = b.x.q[d] + b.h * b.x.qd[d];
  }
}

// Tracking errors after step n; stops diverged lanes.
template <class S>
TWINARM_KERNEL void measure(BatchWork<S>& b, std::size_t n) {
  const double* q_K = b.tables.q_K.data() + (n + 1) * b.measured.size();
  S sum(0);
  for (std::size_t j = 0; j < b.measured.size(); ++j) {
    const S e = magnitude(S(q_K[j]) - b.x.q[b.measured[j]]);
    sum = sum + e;
    b.error_integral[j] = b.error_integral[j] + b.h * (e + b.error_last[j]);
    b.error_last[j] = e;
    b.error_max[j] = larger(b.error_max[j], e);
  }
  const auto outside = ~(sum < b.bound);  // NaN too
  if (!any_lane(outside)) return;
  for (std::size_t lane = 0; lane < sizeof(S) / sizeof(double); ++lane)
    if (outside[lane]) b.stopped(b, lane, n + 1);
}

template <class S>
void run_steps(BatchWork<S>& b) {
  for (std::size_t n = b.first; n < b.last && b.lanes_running > 0; ++n) {
    const double* row = b.tables.motion.data() + n * b.tables.motion_stride;
    if (b.has_joint_springs || b.has_damping) apply_joint_springs(b, row);
    b.model.I = b.model.I_own.data();
    aba(b.model, b.x, b.forces, b.w, LaneSprings<S>{b, row, n});
    integrate(b);
    b.h_before = b.h;
    measure(b, n);
  }
  if (b.last < b.tables.steps || b.lanes_running == 0) return;
  b.model.I = b.model.I_own.data();  // powers at the end, with the last row of the motion
  aba(b.model, b.x, b.forces, b.w,
      LaneSprings<S>{b, b.tables.motion.data() + (b.tables.steps - 1) * b.tables.motion_stride,
                     b.tables.steps});
}

}  // namespace twinarm::TWINARM_ISA
