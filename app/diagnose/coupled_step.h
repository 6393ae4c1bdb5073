// The couplings of a scene as its integrator steps them, in one pose: whether an error grows, with
// gains, rate or step as they are or as they would be.
//
// The parts of coupling/analysis/step_matrix.h about zero offset (app/coupling/posed_couplings.h),
// all couplings together with the dampers of joints. Parts that are evaluated at the same steps are
// one part: the matrix of the step has few rows. Cost of one question: the eigenvalues of that
// matrix.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "app/run/simulate_input.h"
#include "coupling/analysis/step_matrix.h"

namespace twinarm {

class CoupledStep {
 public:
  enum class Gain { stiffness, damping, turn_stiffness, turn_damping, time_constant };
  // About the plan's state. The plan must outlive it.
  explicit CoupledStep(const SimulatePlan& plan);

  bool is_empty() const { return pulls_.empty(); }
  double step() const { return step_; }
  double growth() const { return growth_of(pulls_, integrator_, step_); }
  bool holds() const { return holds_with(pulls_, step_); }
  bool holds_at_step(double step) const { return holds_with(pulls_, step); }
  // With this gain of a coupling (its number in the scene; -1: of all), and no other change.
  bool holds_with_gain(int coupling, Gain gain, double value) const;
  // With its force held for so many steps.
  bool holds_with_hold(int coupling, int steps) const;
  // With all stiffnesses times `factor` and dampings times its root, of the couplings in `which`.
  bool holds_with_softer(const std::vector<int>& which, double factor) const;
  // As implicit springs, under the semi-implicit integrator.
  bool holds_implicitly(const std::vector<int>& which) const;

  // By how much each row's joint falls behind when all targets start at v, at most and in the long
  // run; rows as in app/coupling/prediction.h. Empty where that has no bound.
  struct Lag {
    Eigen::VectorXd start, later;
  };
  Lag lag(const Eigen::VectorXd& v) const;
  Eigen::Index rows() const { return M_.rows(); }

 private:
  struct Pull {
    int coupling = 0;
    bool turns_bushing = false;  // its gains are turn_stiffness, turn_damping
    bool is_weld = false, absolute_damper = false;
    double k = 0, b = 0, time_constant = 0, delay = 0;
    Eigen::MatrixXd square;  // J^T J; empty where the gains leave it open
    CoupledTerm part;
  };
  using Pulls = std::vector<Pull>;
  static Pull with_gain(const Pull& pull, Gain gain, double value);
  std::vector<CoupledTerm> merged(const Pulls& pulls, double step) const;
  double growth_of(const Pulls& pulls, Integrator integrator, double step) const;
  bool holds_with(const Pulls& pulls, double step) const;

  Eigen::MatrixXd M_, joint_damping_;
  Integrator integrator_;
  double step_;
  Pulls pulls_;
};

}  // namespace twinarm
