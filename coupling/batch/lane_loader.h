// What the lanes of a batch run with: the model, its springs, and a cell in each lane.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "coupling/batch/batch_targets.h"
#include "coupling/batch/kernel/batch_state.h"
#include "coupling/batch/merge_fixed_joints.h"
#include "coupling/batch/set_spring.h"
#include "coupling/batch/simd_access.h"

namespace twinarm {

template <int N>
class LaneLoader {
 public:
  using S = Batch<N>;

  // All must outlive it.
  LaneLoader(const BatchSetup& setup, const LumpedModel& lumped, const BatchMotion& motion,
             BatchWork<S>& work)
      : setup_(setup), lumped_(lumped), work_(work) {
    prepare_bodies();
    prepare_pulls(motion);
  }

  // The cell at the start of its run.
  void load(std::size_t lane, const BatchCell& cell) {
    set_lane(work_.bound, lane, setup_.bound);
    set_lane(work_.h_before, lane, 0);
    for (std::size_t i = 0; i < setup_.start.q.size(); ++i)
      set_lane(work_.x.q[i], lane, setup_.start.q[i]);
    for (std::size_t i = 0; i < setup_.start.qd.size(); ++i)
      set_lane(work_.x.qd[i], lane, setup_.start.qd[i]);
    inertias_[lane] = lumped_.inertias(cell.mass_factor);
    for (std::size_t i = 0; i < inertias_[lane].size(); ++i)
      set_lane(work_.model.I_own[i], lane, inertias_[lane][i]);
  }
  // What depends on the length of the step.
  void load_step(std::size_t lane, const BatchCell& cell, double h) {
    set_lane(work_.h, lane, h);
    for (std::size_t i = 0; i < setup_.start.qd.size(); ++i)
      set_lane(work_.forces.armature[i], lane, h * lumped_.model.damping[i]);
    std::vector<Inertia<double>> felt = inertias_[lane];
    for (std::size_t s = 0; s < work_.pulls.size(); ++s)
      load_spring(work_, s, lane, setup_.springs[s], cell.springs[s], h,
                  lumped_.point_of(*setup_.model, static_cast<std::size_t>(setup_.springs[s].body),
                                   cell.springs[s].p_L),
                  felt[work_.pulls[s].body]);
    for (std::size_t i = 0; i < felt.size(); ++i) set_lane(work_.model.I_felt[i], lane, felt[i]);
  }
  // The lane stands still at the start from now on, without springs: their gains may be anything.
  void park(std::size_t lane) {
    for (LanePull<S>& pull : work_.pulls) {
      for (S* gain : {&pull.k, &pull.b, &pull.kb, &pull.b_seen, &pull.m_star})
        set_lane(*gain, lane, 0);
      set_lane(pull.kp, lane, Vec3<double>{});
    }
    for (S& armature : work_.forces.armature) set_lane(armature, lane, 0);
    for (std::size_t i = 0; i < inertias_[lane].size(); ++i)
      set_lane(work_.model.I_felt[i], lane, inertias_[lane][i]);
    set_lane(work_.h, lane, 0);
    set_lane(work_.bound, lane, std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < setup_.start.q.size(); ++i)
      set_lane(work_.x.q[i], lane, setup_.start.q[i]);
    for (S& qd : work_.x.qd) set_lane(qd, lane, 0);
  }

 private:
  void prepare_bodies() {
    const std::size_t n = lumped_.model.parent.size();
    work_.model.I_own.resize(n);
    work_.model.I_felt.resize(n);
    work_.E.resize(n);
    work_.o.resize(n);
    work_.a_bias.resize(n);
    work_.a_bias[0] = {{}, -work_.model.gravity};
    work_.place.assign(n, Place::none);
    for (const double b : lumped_.model.damping) work_.has_damping |= b != 0;
  }
  void prepare_pulls(const BatchMotion& motion) {
    for (std::size_t s = 0; s < setup_.springs.size(); ++s) {
      const BatchSpring& spring = setup_.springs[s];
      const auto body = static_cast<std::size_t>(spring.body);
      LanePull<S> pull;
      pull.kind = kind_of(spring);
      pull.body = lumped_.carrier[body];
      pull.iq = setup_.model->iq[body];
      pull.iv = setup_.model->iv[body];
      pull.motion = motion.places[s].motion;
      pull.energy = motion.places[s].energy;
      pull.sees = sees_of(spring.treatment);
      work_.pulls.push_back(pull);
      const bool at_joint = pull.kind == PullKind::joint;
      work_.has_joint_pulls |= at_joint;
      for (std::size_t i = at_joint ? 0 : pull.body; i > 0; i = parent_of(i)) place(i);
      const bool turned = work_.place[pull.body] == Place::turned;
      work_.has_places |= !at_joint;
      work_.has_points |= pull.kind == PullKind::linear;
      work_.has_bias |=
          spring.treatment != Treatment::explicit_ &&
          (pull.kind == PullKind::linear || (pull.kind == PullKind::world && !turned));
    }
  }
  std::size_t parent_of(std::size_t i) const {
    return static_cast<std::size_t>(lumped_.model.parent[i]);
  }
  void place(std::size_t i) {
    bool in_line = is_in_line(i), turned = in_line;
    for (std::size_t p = parent_of(i); p > 0; p = parent_of(p)) turned &= is_in_line(p);
    work_.place[i] = turned ? Place::turned : in_line ? Place::in_line : Place::general;
    work_.E[i] = Mat3<S>::identity();
  }
  bool is_in_line(std::size_t i) const {
    const Matrix3 E = to_eigen(lumped_.model.Xtree[i].E);
    return lumped_.model.joint[i] == JointType::revolute && E == Matrix3::Identity();
  }

  const BatchSetup& setup_;
  const LumpedModel& lumped_;
  BatchWork<S>& work_;
  std::array<std::vector<Inertia<double>>, N> inertias_;  // by lane, of its lumped bodies
};

}  // namespace twinarm
