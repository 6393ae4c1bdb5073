// Position limits of joints with one dof, as inequalities of the impulse solver: q in [lower,
// upper], plastic (a joint that hits its limit stops there).
#pragma once

#include <vector>

#include "solver/constraint_source.h"
#include "solver/integrator_rewind.h"

namespace twinarm {

class JointLimits final : public ConstraintSource, public Rewindable {
 public:
  struct Limit {
    int body;             // that the joint carries
    double lower, upper;  // infinite where there is none
    double force = 0;     // of the last step, positive at the lower limit [N m, N]
    double work = 0;      // of the last step, on the joint [J]
  };

  explicit JointLimits(const Model<double>& model) : model_(&model) {}
  // Throws std::invalid_argument for a joint that has not one dof, or lower > upper.
  void add(int body, double lower, double upper);
  const std::vector<Limit>& limits() const { return limits_; }

  void begin_step(const Kinematics& k, const State<double>& x, double h) noexcept override;
  bool wants_separation() const noexcept override;
  void add(const ConstraintFrame& frame, ImpulseProblem& problem) noexcept override;
  void take(const ConstraintFrame& frame, const ImpulseProblem& problem,
            std::size_t first) noexcept override;
  void keep() override { kept_ = limits_; }
  void go_back() noexcept override { std::swap(limits_, kept_); }

 private:
  struct Row {
    std::size_t limit;
    double sign;  // +1: velocities away from the lower limit are positive, -1: from the upper
    double gap, after;
  };
  const Model<double>* model_;
  std::vector<Limit> limits_, kept_;
  std::vector<Row> rows_;  // that can be reached in this step
};

}  // namespace twinarm
