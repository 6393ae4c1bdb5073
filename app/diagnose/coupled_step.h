// Stability of all couplings of a scene together, as its integrator steps them, in one pose: with
// the given or with changed gains, rate or step.
//
// Linearised about zero offset (app/coupling/posed_couplings.h), with the dampers of joints, by
// coupling/analysis/step_matrix.h. Terms evaluated at the same steps are summed to keep the matrix
// small. Each query costs its eigenvalues.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "app/run/simulate_input.h"
#include "coupling/analysis/step_matrix.h"

namespace twinarm {

class CoupledStep {
 public:
  enum class Gain { stiffness, damping, rotational_stiffness, rotational_damping, time_constant };
  // About the plan's state. The plan must outlive it.
  explicit CoupledStep(const SimulatePlan& plan);

  bool is_empty() const { return components_.empty(); }
  double step() const { return step_; }
  bool is_stable() const { return is_stable(components_, step_); }
  bool is_stable_at_step(double step) const { return is_stable(components_, step); }
  // With this gain of a coupling (index in the scene; -1: of all).
  bool is_stable_with_gain(int coupling, Gain gain, double value) const;
  // With its force held for that number of steps.
  bool is_stable_with_hold(int coupling, int steps) const;
  // With the stiffnesses and dampings of `couplings` times these factors.
  bool is_stable_with_softer(const std::vector<int>& couplings, double stiffness,
                             double damping) const;
  // With `couplings` as implicit springs and the semi-implicit integrator.
  bool is_stable_with_implicit(const std::vector<int>& couplings) const;

  // Tracking error of each joint when all targets start at velocity v: maximum and steady state;
  // rows as in app/coupling/prediction.h. Empty where it is unbounded.
  struct Errors {
    Eigen::VectorXd start, later;
  };
  Errors tracking_errors(const Eigen::VectorXd& v) const;
  Eigen::Index rows() const { return M_.rows(); }

 private:
  struct Component {
    int coupling = 0;                   // index in the scene
    bool is_bushing_torsional = false;  // gains are rotational_stiffness, rotational_damping
    bool absolute_damper = false;
    double k = 0, b = 0, time_constant = 0, delay = 0;
    Eigen::MatrixXd square;  // J^T J; empty if both gains are zero
    CoupledTerm part;
  };
  using Components = std::vector<Component>;
  static Component with_gain(const Component& component, Gain gain, double value);
  std::vector<CoupledTerm> merged(const Components& components, double step) const;
  double growth_of(const Components& components, Integrator integrator, double step) const;
  bool is_stable(const Components& components, double step) const;

  Eigen::MatrixXd M_, joint_damping_;
  Integrator integrator_;
  double step_;
  Components components_;
};

}  // namespace twinarm
