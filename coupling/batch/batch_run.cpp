#include "coupling/batch/batch_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "coupling/batch/batch_targets.h"
#include "coupling/batch/kernel/batch_state.h"
#include "coupling/batch/merge_fixed_joints.h"
#include "coupling/batch/set_spring.h"
#include "coupling/batch/simd_access.h"
#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/energy.h"
#include "solver/model/convert_model.h"
#include "solver/support/step_size.h"

namespace twinarm {

// batch_kernel.cpp defines these, one for each level of coupling/CMakeLists.txt.
namespace generic {
void run_batch(BatchWork<Batch<2>>& work);
}
#ifdef TWINARM_HAS_LEVELS
namespace v3 {
void run_batch(BatchWork<Batch<4>>& work);
}
namespace v4 {
void run_batch(BatchWork<Batch<8>>& work);
}
#endif

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Cells of equal key share a table, and so may share a batch.
std::vector<double> key_of(const BatchCell& cell) {
  std::vector<double> key{cell.h, cell.speed, cell.delay};
  for (const BatchCell::Gains& gains : cell.springs)
    key.insert(key.end(), {gains.p_L.x(), gains.p_L.y(), gains.p_L.z()});
  return key;
}

}  // namespace

class BatchRun::Driver {
 public:
  virtual ~Driver() = default;
  virtual void run(std::span<const BatchCell> cells, std::span<BatchResult> out) = 0;
  virtual std::size_t lanes() const = 0;
};

template <int N>
class BatchRun::DriverOf final : public Driver {
 public:
  using S = Batch<N>;
  using Work = BatchWork<S>;
  using Kernel = void (*)(Work&);

  DriverOf(const BatchSetup& setup, Kernel kernel)
      : setup_(setup),
        kernel_(kernel),
        lumped_(*setup.model),
        motion_(setup),
        work_(convert<S>(lumped_.model)),
        one_lane_(lumped_.model) {
    work_.owner = this;
    work_.stopped = [](Work& work, std::size_t lane, std::size_t step) {
      static_cast<DriverOf*>(work.owner)->stop(lane, step);
    };
    work_.has_energy = setup_.energy;
    prepare_bodies();
    prepare_pulls();
    work_.measured = setup_.measured;
    for (auto* by_joint :
         {&work_.error_integral, &work_.error_max, &work_.error_last, &work_.window_error_of})
      by_joint->resize(work_.measured.size());
  }

  std::size_t lanes() const override { return N; }

  void run(std::span<const BatchCell> cells, std::span<BatchResult> out) override {
    std::vector<std::pair<std::vector<double>, std::size_t>> order;
    order.reserve(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c) order.emplace_back(key_of(cells[c]), c);
    std::stable_sort(order.begin(), order.end());
    for (std::size_t first = 0; first < order.size();) {
      if (key_ != order[first].first) {
        key_ = order[first].first;
        motion_.fill(setup_, lumped_, cells[order[first].second]);
      }
      count_ = 0;
      while (count_ < N && first < order.size() && order[first].first == key_) {
        const std::size_t c = order[first++].second;
        cell_[count_] = &cells[c];
        result_[count_] = &out[c];
        ++count_;
      }
      run_batch();
    }
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
  void prepare_pulls() {
    for (std::size_t s = 0; s < setup_.springs.size(); ++s) {
      const BatchSpring& spring = setup_.springs[s];
      const auto body = static_cast<std::size_t>(spring.body);
      LanePull<S> pull;
      pull.kind = kind_of(spring);
      pull.body = lumped_.carrier[body];
      pull.iq = setup_.model->iq[body];
      pull.iv = setup_.model->iv[body];
      pull.motion = motion_.places[s].motion;
      pull.energy = motion_.places[s].energy;
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

  void run_batch() {
    work_.steps = motion_.steps;
    work_.motion = motion_.motion.data();
    work_.energy = motion_.energy.data();
    work_.is_corner = motion_.is_corner.data();
    work_.q_K = motion_.q_K.data();
    work_.motion_stride = motion_.motion_stride;
    work_.energy_stride = motion_.energy_stride;
    work_.lanes_running = count_;
    for (std::size_t lane = 0; lane < N; ++lane) {
      runs_[lane] = lane < count_;
      load(lane, *cell_[std::min(lane, count_ - 1)]);
      if (!runs_[lane]) park(lane);
    }
    start_measures();
    const bool shorter = motion_.last_step != cell_[0]->h;
    work_.first = 0;
    work_.last = shorter ? motion_.steps - 1 : motion_.steps;
    kernel_(work_);
    if (shorter && work_.lanes_running > 0) {
      for (std::size_t lane = 0; lane < N; ++lane) load_step(lane, motion_.last_step);
      work_.first = work_.last;
      work_.last = motion_.steps;
      kernel_(work_);
    }
    for (std::size_t lane = 0; lane < count_; ++lane)
      if (runs_[lane]) store(lane);
  }

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
    load_step(lane, cell.h);
  }
  // What depends on the length of the step.
  void load_step(std::size_t lane, double h) {
    if (!runs_[lane]) return;
    const BatchCell& cell = *cell_[lane];
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
  void start_measures() {
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
    set_lane(work_.bound, lane, kInfinite);
    for (std::size_t i = 0; i < setup_.start.q.size(); ++i)
      set_lane(work_.x.q[i], lane, setup_.start.q[i]);
    for (S& qd : work_.x.qd) set_lane(qd, lane, 0);
  }
  void stop(std::size_t lane, std::size_t step) {
    if (!runs_[lane]) return;
    runs_[lane] = false;
    --work_.lanes_running;
    BatchResult& result = *result_[lane];
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
    park(lane);
  }

  void store(std::size_t lane) {
    BatchResult& result = *result_[lane];
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
    if (setup_.energy) store_energies(lane, result);
  }
  void store_energies(std::size_t lane, BatchResult& result) {
    one_lane_.I = lumped_.inertias(cell_[lane]->mass_factor);
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

  BatchSetup setup_;
  Kernel kernel_;
  LumpedModel lumped_;
  BatchMotion motion_;
  Work work_;
  Model<double> one_lane_;
  std::vector<double> key_;  // of the table in motion_

  std::size_t count_ = 0;  // cells of the batch
  std::array<const BatchCell*, N> cell_{};
  std::array<BatchResult*, N> result_{};
  std::array<bool, N> runs_{};
  std::array<std::vector<Inertia<double>>, N> inertias_;  // of its lumped bodies
};

BatchRun::BatchRun(const BatchSetup& setup) {
  FaultList faults;
  faults.add(batch_faults(setup));
  faults.check();
#ifdef TWINARM_HAS_LEVELS
  if (best_isa() == Isa::v4) driver_ = std::make_unique<DriverOf<8>>(setup, &v4::run_batch);
  if (best_isa() == Isa::v3) driver_ = std::make_unique<DriverOf<4>>(setup, &v3::run_batch);
#endif
  if (!driver_) driver_ = std::make_unique<DriverOf<2>>(setup, &generic::run_batch);
}
BatchRun::~BatchRun() = default;
BatchRun::BatchRun(BatchRun&&) noexcept = default;
BatchRun& BatchRun::operator=(BatchRun&&) noexcept = default;

void BatchRun::run(std::span<const BatchCell> cells, std::span<BatchResult> out) {
  for (const BatchCell& cell : cells) check_step_size(cell.h);
  driver_->run(cells, out);
}
std::size_t BatchRun::lanes() const {
  return driver_->lanes();
}

}  // namespace twinarm
