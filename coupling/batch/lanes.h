// Loading cells into the lanes of a batch, and storing the results of each lane.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "coupling/batch/batch_model.h"
#include "coupling/batch/batch_targets.h"
#include "solver/dynamics/energy_momentum.h"
#include "solver/forces/spring.h"
#include "solver/model/convert_model.h"
#include "solver/spatial/batch.h"

namespace twinarm {

// ---- access to one lane of vectors and inertias ----

template <class S>
void set_lane(Vec3<S>& all, std::size_t lane, const Vec3<double>& value) {
  set_lane(all.x, lane, value.x), set_lane(all.y, lane, value.y), set_lane(all.z, lane, value.z);
}
template <class S>
void set_lane(Inertia<S>& all, std::size_t lane, const Inertia<double>& value) {
  set_lane(all.m, lane, value.m);
  set_lane(all.h, lane, value.h);
  const auto part = [&](S Sym3<S>::*to, double Sym3<double>::*from) {
    set_lane(all.I.*to, lane, value.I.*from);
  };
  part(&Sym3<S>::xx, &Sym3<double>::xx), part(&Sym3<S>::yy, &Sym3<double>::yy);
  part(&Sym3<S>::zz, &Sym3<double>::zz), part(&Sym3<S>::xy, &Sym3<double>::xy);
  part(&Sym3<S>::xz, &Sym3<double>::xz), part(&Sym3<S>::yz, &Sym3<double>::yz);
}

inline SpringTime time_of(Discretization discretization) {
  return discretization == Discretization::explicit_       ? SpringTime::start
         : discretization == Discretization::semi_implicit ? SpringTime::both
                                                           : SpringTime::end;
}

// Added inertia m* of the discretization (solver/forces/spring.h).
inline double m_star(Discretization discretization, double h, const BatchCell::Gains& gains) {
  const double by_damper = discretization == Discretization::explicit_ ? 0 : h * gains.b;
  return by_damper + (discretization == Discretization::implicit ? h * h * gains.k : 0);
}

// Of a flywheel, or of a particle at p.
inline Inertia<double> added_inertia(SpringKind kind, double m, const Vec3<double>& p) {
  if (kind == SpringKind::world) return {0, {}, Sym3<double>::scaled_identity(m)};
  return particle_inertia(m, p);
}

// Writes a cell's spring to a lane; p: its point in body axes. The added inertia goes to
// `effective` or to the joint's armature.
template <class S>
void load_spring(BatchWork<S>& work, std::size_t s, std::size_t lane, const BatchSpring& spring,
                 const BatchCell::Gains& gains, double h, const Vec3<double>& p,
                 Inertia<double>& effective) {
  LaneSpring<S>& lane_spring = work.springs[s];
  const double position_lead = spring.discretization == Discretization::implicit ? h : 0;
  const double m = m_star(spring.discretization, h, gains);
  set_lane(lane_spring.k, lane, gains.k);
  set_lane(lane_spring.b, lane, gains.b);
  set_lane(lane_spring.kb, lane, gains.k * position_lead + gains.b);
  set_lane(lane_spring.b_seen, lane, spring.absolute_damper ? 0 : gains.b);
  set_lane(lane_spring.m_star, lane, m);
  set_lane(lane_spring.p_B, lane, p);
  set_lane(lane_spring.kp, lane, gains.k * p);
  if (lane_spring.kind == SpringKind::joint) {
    S& armature = work.forces.armature[lane_spring.iv];
    set_lane(armature, lane, lane_of(armature, lane) + m);
  } else {
    add_congruence(Transform<double>{}, added_inertia(lane_spring.kind, m, p), effective);
  }
}

template <int N>
class Lanes {
 public:
  using S = Batch<N>;

  // All must outlive it.
  Lanes(const BatchSetup& setup, const ModelWithoutFixedJoints& merged, const BatchMotion& motion,
        BatchWork<S>& work)
      : setup_(setup), merged_(merged), motion_(motion), work_(work) {
    work_.measured = setup.measured;
    for (auto* by_joint : {&work_.error_integral, &work_.error_max, &work_.error_last})
      by_joint->resize(work_.measured.size());
    prepare_bodies();
    prepare_springs();
  }

  // All lanes at the start of a run.
  void start() {
    constexpr double kBound = 1e3;  // on the sum of |q_K - q_D|
    work_.bound = S(kBound);
    work_.h_before = S(0);
    work_.x = convert<S>(setup_.start);
    for (S* sum : {&work_.dissipated_work, &work_.input_work, &work_.input_work_min}) *sum = S(0);
    for (std::size_t j = 0; j < work_.measured.size(); ++j) {
      const double e = std::abs(motion_.q_K[j] - setup_.start.q[work_.measured[j]]);
      work_.error_max[j] = S(e);
      work_.error_integral[j] = S(0);
      work_.error_last[j] = S(e);
    }
  }
  // Values that depend on the step size.
  void load_step(std::size_t lane, const BatchCell& cell, double h) {
    set_lane(work_.h, lane, h);
    for (std::size_t i = 0; i < setup_.start.qd.size(); ++i)
      set_lane(work_.forces.armature[i], lane, h * merged_.model.damping[i]);
    std::vector<Inertia<double>> effective = merged_.model.I;
    for (std::size_t s = 0; s < work_.springs.size(); ++s)
      load_spring(work_, s, lane, setup_.springs[s], cell.springs[s], h,
                  merged_.point_of(*setup_.model, static_cast<std::size_t>(setup_.springs[s].body),
                                   cell.springs[s].p_L),
                  effective[work_.springs[s].body]);
    for (std::size_t i = 0; i < effective.size(); ++i)
      set_lane(work_.model.I_effective[i], lane, effective[i]);
  }
  // Stops the lane at the start state, without springs.
  void park(std::size_t lane) {
    for (LaneSpring<S>& lane_spring : work_.springs) {
      for (S* gain : {&lane_spring.k, &lane_spring.b, &lane_spring.kb, &lane_spring.b_seen,
                      &lane_spring.m_star})
        set_lane(*gain, lane, 0);
      set_lane(lane_spring.kp, lane, Vec3<double>{});
    }
    for (S& armature : work_.forces.armature) set_lane(armature, lane, 0);
    for (std::size_t i = 0; i < merged_.model.I.size(); ++i)
      set_lane(work_.model.I_effective[i], lane, merged_.model.I[i]);
    set_lane(work_.h, lane, 0);
    set_lane(work_.bound, lane, std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < setup_.start.q.size(); ++i)
      set_lane(work_.x.q[i], lane, setup_.start.q[i]);
    for (S& qd : work_.x.qd) set_lane(qd, lane, 0);
  }

  // Results of a lane that has diverged.
  void stop(std::size_t step, BatchResult& result) const {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    result.steps = step;
    result.finished = false;
    result.max_error.assign(work_.measured.size(), kInfinite);
    result.mean_error.assign(work_.measured.size(), kInfinite);
    result.energy_created = kInfinite;
    result.input_work_min = -kInfinite;
  }
  // Results of a finished lane.
  void store(std::size_t lane, BatchResult& result) const {
    result.steps = motion_.steps;
    result.finished = true;
    result.max_error.clear();
    result.mean_error.clear();
    for (std::size_t j = 0; j < work_.measured.size(); ++j) {
      const double twice = lane_of(work_.error_integral[j], lane);
      result.max_error.push_back(lane_of(work_.error_max[j], lane));
      result.mean_error.push_back(0.5 * twice / setup_.duration);
    }
    result.target_lower = motion_.low;
    result.target_upper = motion_.high;
    store_energies(lane, result);
  }

 private:
  void prepare_bodies() {
    const std::size_t n = merged_.model.parent.size();
    for (const Inertia<double>& inertia : merged_.model.I)
      work_.model.I_own.push_back(convert<S>(inertia));
    work_.model.I_effective.resize(n);
    work_.E.resize(n);
    work_.o.resize(n);
    work_.a_bias.resize(n);
    work_.a_bias[0] = {{}, -work_.model.gravity};
    work_.frames.assign(n, Frame::none);
    for (const double b : merged_.model.damping) work_.has_damping |= b != 0;
  }
  void prepare_springs() {
    for (std::size_t s = 0; s < setup_.springs.size(); ++s) {
      const BatchSpring& spring = setup_.springs[s];
      const auto body = static_cast<std::size_t>(spring.body);
      LaneSpring<S> lane_spring;
      lane_spring.kind = spring.kind;
      lane_spring.body = merged_.carrier[body];
      lane_spring.iq = setup_.model->iq[body];
      lane_spring.iv = setup_.model->iv[body];
      lane_spring.motion = motion_.places[s].motion;
      lane_spring.energy = motion_.places[s].energy;
      lane_spring.time = time_of(spring.discretization);
      work_.springs.push_back(lane_spring);
      const bool at_joint = lane_spring.kind == SpringKind::joint;
      work_.has_joint_springs |= at_joint;
      for (std::size_t i = at_joint ? 0 : lane_spring.body; i > 0; i = parent_of(i))
        choose_frame(i);
      const bool planar = work_.frames[lane_spring.body] == Frame::planar;
      work_.needs_rotations |= !at_joint;
      work_.needs_origins |= lane_spring.kind == SpringKind::linear;
      work_.needs_bias |= spring.discretization != Discretization::explicit_ &&
                          (lane_spring.kind == SpringKind::linear ||
                           (lane_spring.kind == SpringKind::world && !planar));
    }
  }
  std::size_t parent_of(std::size_t i) const {
    return static_cast<std::size_t>(merged_.model.parent[i]);
  }
  void choose_frame(std::size_t i) {
    bool aligned = is_aligned(i), planar = aligned;
    for (std::size_t p = parent_of(i); p > 0; p = parent_of(p)) planar &= is_aligned(p);
    work_.frames[i] = planar ? Frame::planar : aligned ? Frame::aligned : Frame::general;
    work_.E[i] = Mat3<S>::identity();
  }
  bool is_aligned(std::size_t i) const {
    const Matrix3 E = to_eigen(merged_.model.Xtree[i].E);
    return merged_.model.joint[i] == JointType::revolute && E == Matrix3::Identity();
  }

  void store_energies(std::size_t lane, BatchResult& result) const {
    const auto energy = [&](const State<double>& x) {
      return kinetic_energy(merged_.model, x) + potential_energy(merged_.model, x);
    };
    State<double> end = setup_.start;
    for (std::size_t i = 0; i < end.q.size(); ++i) end.q[i] = lane_of(work_.x.q[i], lane);
    for (std::size_t i = 0; i < end.qd.size(); ++i) end.qd[i] = lane_of(work_.x.qd[i], lane);
    result.energy_created = energy(end) - energy(setup_.start) +
                            lane_of(work_.spring_energy, lane) -
                            lane_of(work_.spring_energy_at_start, lane) -
                            lane_of(work_.input_work, lane) + lane_of(work_.dissipated_work, lane);
    result.input_work_min = lane_of(work_.input_work_min, lane);
  }

  const BatchSetup& setup_;
  const ModelWithoutFixedJoints& merged_;
  const BatchMotion& motion_;
  BatchWork<S>& work_;
};

}  // namespace twinarm
