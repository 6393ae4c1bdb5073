// What is measured of a batch, from its start to the results of each lane.
#pragma once

#include <cmath>
#include <limits>

#include "coupling/batch/batch_targets.h"
#include "coupling/batch/kernel/batch_state.h"
#include "coupling/batch/merge_fixed_joints.h"
#include "coupling/batch/simd_access.h"
#include "solver/dynamics/energy_momentum.h"

namespace twinarm {

template <int N>
class LaneResults {
 public:
  using S = Batch<N>;

  // All must outlive it.
  LaneResults(const BatchSetup& setup, const LumpedModel& lumped, const BatchMotion& motion,
              BatchWork<S>& work)
      : setup_(setup), lumped_(lumped), motion_(motion), work_(work), one_lane_(lumped.model) {
    work_.has_energy = setup.energy;
    work_.measured = setup.measured;
    for (auto* by_joint :
         {&work_.error_integral, &work_.error_max, &work_.error_last, &work_.window_error_of})
      by_joint->resize(work_.measured.size());
  }

  void start() {
    for (S* sum : {&work_.lost_work, &work_.hand_work, &work_.hand_work_least}) *sum = S(0);
    work_.window_error.fill(S(0));
    for (std::size_t j = 0; j < work_.measured.size(); ++j) {
      const double e = std::abs(motion_.q_K[j] - setup_.start.q[work_.measured[j]]);
      work_.error_max[j] = S(0);
      work_.window_error_of[j] = S(e);
      work_.error_integral[j] = S(0);
      work_.error_last[j] = S(e);
    }
  }

  // Of a lane that has left all bounds in a step.
  void stop(std::size_t lane, std::size_t step, BatchResult& result) const {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    result.steps = step;
    result.finished = false;
    result.max_error.assign(work_.measured.size(), kInfinite);
    result.mean_error.assign(work_.measured.size(), kInfinite);
    for (std::size_t q = 0; q < BatchResult::kWindows; ++q)
      result.window_error[q] = step > (q + 1) * motion_.steps / BatchResult::kWindows
                                   ? lane_of(work_.window_error[q], lane)
                                   : kInfinite;
    result.energy_created = kInfinite;
    result.hand_work_least = -kInfinite;
  }
  // Of a lane at the end.
  void store(std::size_t lane, const BatchCell& cell, BatchResult& result) {
    result.steps = motion_.steps;
    result.finished = true;
    result.max_error.clear();
    result.mean_error.clear();
    for (std::size_t j = 0; j < work_.measured.size(); ++j) {
      const double twice = lane_of(work_.error_integral[j], lane);
      result.max_error.push_back(lane_of(work_.error_max[j], lane));
      result.mean_error.push_back(0.5 * twice / setup_.duration);
    }
    result.twin_low = motion_.low;
    result.twin_high = motion_.high;
    for (std::size_t q = 0; q < BatchResult::kWindows; ++q)
      result.window_error[q] = lane_of(work_.window_error[q], lane);
    if (setup_.energy) store_energies(lane, cell, result);
  }

 private:
  void store_energies(std::size_t lane, const BatchCell& cell, BatchResult& result) {
    one_lane_.I = lumped_.inertias(cell.mass_factor);
    const auto energy = [&](const State<double>& x) {
      return kinetic_energy(one_lane_, x) + potential_energy(one_lane_, x);
    };
    State<double> end = setup_.start;
    for (std::size_t i = 0; i < end.q.size(); ++i) end.q[i] = lane_of(work_.x.q[i], lane);
    for (std::size_t i = 0; i < end.qd.size(); ++i) end.qd[i] = lane_of(work_.x.qd[i], lane);
    result.energy_created = energy(end) - energy(setup_.start) +
                            lane_of(work_.spring_energy, lane) -
                            lane_of(work_.spring_energy_at_start, lane) -
                            lane_of(work_.hand_work, lane) + lane_of(work_.lost_work, lane);
    result.hand_work_least = lane_of(work_.hand_work_least, lane);
  }

  const BatchSetup& setup_;
  const LumpedModel& lumped_;
  const BatchMotion& motion_;
  BatchWork<S>& work_;
  Model<double> one_lane_;
};

}  // namespace twinarm
