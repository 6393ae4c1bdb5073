// Position limits of joints with one dof, as inequalities of the impulse solver: q in [lower,
// upper], plastic (a joint that hits its limit stops there).
#pragma once

#include <vector>

#include "solver/impulses/event_source.h"
#include "solver/support/checkpointable.h"

namespace twinarm {

class JointLimits final : public ConstraintSource, public EventSource, public Checkpointable {
 public:
  struct Limit {
    int body;             // that the joint carries
    double lower, upper;  // infinite where there is none
    double force = 0;     // of the last step, positive at the lower limit [N m, N]
    double work = 0;      // of all steps so far, on the joint [J]
  };

  explicit JointLimits(const Model<double>& model) : model_(&model) {}
  // Throws std::invalid_argument for a joint that has not one dof, or lower > upper.
  void add(int body, double lower, double upper);
  const std::vector<Limit>& limits() const { return limits_; }

  void begin_step(const Kinematics& k, const State<double>& x, double h) noexcept override;
  bool needs_position_correction() const noexcept override;
  void add(const ConstraintFrame& frame, ImpulseProblem& problem) noexcept override;
  void take(const ConstraintFrame& frame, const ImpulseProblem& problem,
            std::size_t first) noexcept override;
  bool has_closing_contact(const ConstraintFrame& frame) noexcept override;
  EventSource* events() override { return this; }
  void hold(const ConstraintFrame& frame, bool struck) noexcept override;
  void restore_active_set() noexcept override;
  void look(const ConstraintFrame& frame, NextEvent& nearest) const noexcept override;
  void modes(std::vector<char>& modes) const noexcept override;
  std::span<double> works() noexcept override { return flow_works_; }
  void commit_work() noexcept override;

  void serialize(StateArchive& memory) override {
    for (Limit& limit : limits_) memory.visit(limit.force), memory.visit(limit.work);
    memory.resize(held_, 2 * sizeof(double));
    for (Held& held : held_) {
      memory.visit_index(held.limit, limits_.size());
      memory.visit(held.sign);
      memory.visit(held.opens);
    }
  }

 private:
  struct Row {
    std::size_t limit;
    double sign;  // +1: velocities away from the lower limit are positive, -1: from the upper
    double gap, after = 0;
  };
  struct Held {
    std::size_t limit;
    double sign;
    bool opens = false;
  };
  bool takes_part(const ConstraintFrame& frame, const Row& row) const;
  const Held* held(const Row& row) const;
  double speed(const Row& row, const State<double>& x) const;
  const Model<double>* model_;
  std::vector<Limit> limits_;
  std::vector<Row> rows_;  // that can be reached in this step
  std::vector<Held> held_, held_before_;
  std::vector<double> flow_works_;  // of each held
};

}  // namespace twinarm
