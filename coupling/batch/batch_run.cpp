#include "coupling/batch/batch_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "coupling/batch/batch_model.h"
#include "coupling/batch/lanes.h"
#include "solver/dynamics/dynamics.h"
#include "solver/model/convert_model.h"
#include "solver/support/number_text.h"

namespace twinarm {

// Defined in batch_kernel.cpp for each instruction set.
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

// Cells of equal key share a motion table and can share a batch.
std::vector<double> key_of(const BatchCell& cell) {
  std::vector<double> key{cell.h, cell.speed, cell.delay};
  for (const BatchCell::Gains& gains : cell.springs)
    key.insert(key.end(), {gains.p_L.x(), gains.p_L.y(), gains.p_L.z()});
  return key;
}

template <int N>
class BatchRunnerN final : public BatchRun::Driver {
 public:
  using S = Batch<N>;
  using Work = BatchWork<S>;
  using Kernel = void (*)(Work&);

  BatchRunnerN(const BatchSetup& setup, Kernel kernel)
      : setup_(setup),
        kernel_(kernel),
        merged_(*setup.model),
        motion_(setup),
        work_(convert<S>(merged_.model), motion_),
        lanes_(setup_, merged_, motion_, work_) {
    work_.owner = this;
    work_.stopped = [](Work& work, std::size_t lane, std::size_t step) {
      static_cast<BatchRunnerN*>(work.owner)->stop(lane, step);
    };
  }

  std::size_t lanes() const override { return N; }

  void run(std::span<const BatchCell> cells, std::span<BatchResult> out) override {
    std::vector<std::pair<std::vector<double>, std::size_t>> order;
    order.reserve(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c) order.emplace_back(key_of(cells[c]), c);
    std::stable_sort(order.begin(), order.end());
    for (std::size_t first = 0; first < order.size();) {
      if (key_ != order[first].first) {
        key_.clear();  // in case fill() throws
        motion_.fill(setup_, merged_, cells[order[first].second]);
        key_ = order[first].first;
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
  void run_batch() {
    work_.lanes_running = count_;
    lanes_.start();
    for (std::size_t lane = 0; lane < N; ++lane) {
      runs_[lane] = lane < count_;
      if (runs_[lane])
        lanes_.load_step(lane, *cell_[lane], cell_[lane]->h);
      else
        lanes_.park(lane);
    }
    const bool shorter = motion_.last_step != cell_[0]->h;
    work_.first = 0;
    work_.last = shorter ? motion_.steps - 1 : motion_.steps;
    kernel_(work_);
    if (shorter && work_.lanes_running > 0) {
      for (std::size_t lane = 0; lane < N; ++lane)
        if (runs_[lane]) lanes_.load_step(lane, *cell_[lane], motion_.last_step);
      work_.first = work_.last;
      work_.last = motion_.steps;
      kernel_(work_);
    }
    for (std::size_t lane = 0; lane < count_; ++lane)
      if (runs_[lane]) lanes_.store(lane, *result_[lane]);
  }

  void stop(std::size_t lane, std::size_t step) {
    if (!runs_[lane]) return;
    runs_[lane] = false;
    --work_.lanes_running;
    lanes_.stop(step, *result_[lane]);
    lanes_.park(lane);
  }

  BatchSetup setup_;
  Kernel kernel_;
  ModelWithoutFixedJoints merged_;
  BatchMotion motion_;
  Work work_;
  Lanes<N> lanes_;
  std::vector<double> key_;  // of the table in motion_
  std::size_t count_ = 0;    // cells of the batch
  std::array<const BatchCell*, N> cell_{};
  std::array<BatchResult*, N> result_{};
  std::array<bool, N> runs_{};
};

}  // namespace

BatchRun::BatchRun(const BatchSetup& setup) {
  DiagnosticList faults;
  faults.add(batch_faults(setup));
  faults.check();
#ifdef TWINARM_HAS_LEVELS
  if (best_isa() == Isa::v4) driver_ = std::make_unique<BatchRunnerN<8>>(setup, &v4::run_batch);
  if (best_isa() == Isa::v3) driver_ = std::make_unique<BatchRunnerN<4>>(setup, &v3::run_batch);
#endif
  if (!driver_) driver_ = std::make_unique<BatchRunnerN<2>>(setup, &generic::run_batch);
}

void BatchRun::run(std::span<const BatchCell> cells, std::span<BatchResult> out) {
  for (const BatchCell& cell : cells) check_step_size(cell.h);
  driver_->run(cells, out);
}

namespace {

constexpr const char* kSingleRuns = "run the cells one by one";

bool is_batchable(JointType type) {
  return type == JointType::fixed || type == JointType::revolute || type == JointType::prismatic ||
         type == JointType::screw;
}

void check_model(const Model<double>& model, DiagnosticList& faults) {
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    const std::string where = "joint '" + model.joint_name[i] + "'";
    if (!is_batchable(model.joint[i]))
      faults.add(where,
                 std::string("batched runs support revolute, prismatic, screw and fixed joints, "
                             "not ") +
                     name_of(model.joint[i]) + " joints",
                 kSingleRuns, "batch.joint");
    for (std::size_t d = model.iv[i]; d < model.iv[i] + model.dofs(i); ++d)
      if (model.coulomb_plus[d] != 0 || model.coulomb_minus[d] != 0)
        faults.add(where, "batched runs do not support Coulomb friction",
                   "run the cells one by one, or without friction", "batch.friction");
  }
  for (const Mimic& mimic : model.mimics)
    for (std::size_t i = 1; i < model.parent.size(); ++i)
      if (model.iv[i] == mimic.follower && model.dofs(i) > 0)
        faults.add("joint '" + model.joint_name[i] + "'",
                   "batched runs do not support mimic joints", kSingleRuns, "batch.mimic");
}

bool moves(const Model<double>& model, int body) {
  for (int i = body; i > 0; i = model.parent[static_cast<std::size_t>(i)])
    if (model.joint[static_cast<std::size_t>(i)] != JointType::fixed) return true;
  return false;
}

void check_driven(const Model<double>& model, const std::string& joint, DiagnosticList& faults) {
  const int body = model.find_joint(joint);
  if (body < 0)
    faults.add("joint '" + joint + "'", "the robot has no such joint", "use the name of a joint",
               "batch.unknown-joint");
  else if (model.dofs(static_cast<std::size_t>(body)) != 1)
    faults.add("joint '" + joint + "'", "a driven joint must have one degree of freedom",
               "run the cells one by one, or leave it out", "batch.still-joint");
}

void check_spring(const BatchSetup& setup, std::size_t s, DiagnosticList& faults) {
  const BatchSpring& spring = setup.springs[s];
  const Model<double>& model = *setup.model;
  const std::string where = "spring " + std::to_string(s);
  if (spring.target >= setup.targets.size())
    faults.add(where, "target " + std::to_string(spring.target) + " does not exist",
               "give an index below " + std::to_string(setup.targets.size()), "batch.target");
  if (spring.body <= 0 || spring.body >= model.body_count() || !moves(model, spring.body))
    faults.add(where, "body index " + std::to_string(spring.body) + " is not a moving link",
               "give the index of a moving link", "batch.link");
  else if (spring.kind == SpringKind::joint &&
           model.dofs(static_cast<std::size_t>(spring.body)) != 1)
    faults.add(where, "its joint has no degree of freedom", "give another link", "batch.joint");
}

}  // namespace

std::vector<Diagnostic> batch_faults(const BatchSetup& setup) {
  DiagnosticList faults;
  const Model<double>& model = *setup.model;
  check_model(model, faults);
  if (setup.targets.empty())
    faults.add("targets", "there is no target robot", "give at least one", "batch.targets");
  for (const BatchTarget& target : setup.targets) {
    for (const std::string& joint : target.joints.turned) check_driven(model, joint, faults);
    if (!target.joints.gripper.empty()) check_driven(model, target.joints.gripper, faults);
  }
  for (std::size_t s = 0; s < setup.springs.size(); ++s) check_spring(setup, s, faults);
  for (const std::size_t iq : setup.measured)
    if (iq >= model.nq)
      faults.add("measured", "coordinate " + std::to_string(iq) + " does not exist",
                 "give an index below " + std::to_string(model.nq), "batch.measured");
  if (!(setup.duration > 0) || !std::isfinite(setup.duration))
    faults.add("duration", "is " + short_number_text(setup.duration) + " s",
               "give a positive number of seconds", "batch.duration");
  return faults.faults();
}

}  // namespace twinarm
