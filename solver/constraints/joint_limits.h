// Position limits of joints with one degree of freedom: unilateral, q in [lower, upper], inelastic.
#pragma once

#include <algorithm>
#include <vector>

#include "solver/constraints/event_source.h"
#include "solver/support/checkpointable.h"

namespace twinarm {

class JointLimits final : public ConstraintSource, public EventSource, public Checkpointable {
 public:
  struct Limit {
    int body;             // child of the joint
    double lower, upper;  // infinite: no limit
    double force = 0;     // joint force of the last step, positive at the lower limit [N m, N]
    double work = 0;      // on the joint, since the start [J]
  };

  explicit JointLimits(const Model<double>& model) : model_(&model) {}
  // Throws std::invalid_argument for a joint without exactly one degree of freedom, or lower >
  // upper.
  void add(int body, double lower, double upper);
  const std::vector<Limit>& limits() const { return limits_; }

  void begin_step(const Kinematics& k, const State<double>& x, double h) noexcept override;
  bool needs_position_correction() const noexcept override;
  void add_constraints(const ConstraintFrame& frame, ImpulseProblem& problem) noexcept override;
  void read_impulses(const ConstraintFrame& frame, const ImpulseProblem& problem,
                     std::size_t first) noexcept override;
  bool has_closing_contact(const ConstraintFrame& frame) noexcept override;
  EventSource* events() override { return this; }
  void set_active_set(const ConstraintFrame& frame, bool impact) noexcept override;
  void restore_active_set() noexcept override {
    std::fill(integrals_.begin(), integrals_.end(), 0);
  }
  void find_next_event(const ConstraintFrame& frame, NextEvent& next) const noexcept override {
    for (const Row& row : rows_)
      if (!find_active(row)) next.include(row.gap, speed(row, frame.x));
  }
  void append_modes(std::vector<char>& modes) const noexcept override {
    for (const Row& row : rows_)
      if (auto* a = find_active(row)) modes.push_back(a->is_separating ? separating : sticking);
  }
  std::span<double> work_integrals() noexcept override { return integrals_; }
  void commit_work() noexcept override {
    for (std::size_t i = 0; i < held_.size(); ++i) limits_[held_[i].limit].work += integrals_[i];
  }

  void serialize(StateArchive& archive) override {
    for (Limit& limit : limits_) archive.visit(limit.force, limit.work);
    archive.resize(held_, 2 * sizeof(double));
    for (Active& active : held_) {
      archive.visit_index(active.limit, limits_.size());
      archive.visit(active.sign, active.is_separating);
    }
  }

 private:
  struct Row {
    std::size_t limit;
    double sign;            // u = sign qd: +1 at the lower limit, -1 at the upper limit
    double gap, after = 0;  // at the start and end of the step
  };
  struct Active {
    std::size_t limit;
    double sign;
    bool is_separating = false;
  };
  bool is_included(const ConstraintFrame& frame, const Row& row) const {
    if (frame.phase == Phase::smooth) return find_active(row) != nullptr;
    return frame.phase != Phase::impact_at_event || row.gap <= kClosed;
  }
  const Active* find_active(const Row& row) const;
  // Velocity away from the limit.
  double speed(const Row& row, const State<double>& x) const {
    return row.sign * x.qd[model_->iv[static_cast<std::size_t>(limits_[row.limit].body)]];
  }
  const Model<double>* model_;
  std::vector<Limit> limits_;
  std::vector<Row> rows_;  // reachable in this step
  std::vector<Active> held_, held_before_;
  std::vector<double> integrals_;  // by active limit
};

}  // namespace twinarm
