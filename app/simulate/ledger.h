// Where the joules come from: work done on the bodies from the start of a run, row by row.
//
//   KE(t) - KE(0) = gravity + actuators + wrenches + damping + friction + numerical
// Gravity is exact, by its potential; so is a constant torque on a joint whose velocity is the rate
// of its coordinate. All others are integrals of power over each step: by the trapezoidal rule for
// integrators of order 1 and 2, by Simpson's rule and by Lobatto's of order 6 for those of order 4
// and 5, at states that a side step finds, so that `numerical` is the integrator's error and not
// the ledger's.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/dynamics/robot_input.h"
#include "app/simulate/given_forces.h"
#include "solver/integrator.h"

namespace twinarm {

struct LedgerRow {
  std::string name;
  double work = 0;  // [J]
};

class Ledger {
 public:
  // All must outlive it.
  Ledger(const RobotInput& input, const std::vector<GivenWrench>& wrenches, Integrator integrator);

  // Where within a step, as parts of it, the state is asked for besides its ends.
  std::span<const double> inner_nodes() const;
  // A step of h from the state of the last call (or the start), by way of inner_nodes().
  void add_step(double h, const std::vector<State<double>>& inner, const State<double>& end);
  const State<double>& now() const { return now_; }
  std::vector<LedgerRow> rows() const;  // `numerical` last

 private:
  struct Actuator {
    const NamedJoint* joint;
    bool is_exact;
  };
  struct Friction {
    std::string joint;
    std::size_t iv, nv;
  };
  void find_rows(Integrator integrator);
  std::vector<double> powers(const State<double>& x) const;  // by integrals_

  const RobotInput& input_;
  const std::vector<GivenWrench>& wrenches_;
  std::vector<Actuator> actuators_;
  std::vector<Friction> damped_, rubbing_;
  std::vector<LedgerRow> integrals_;
  std::vector<double> nodes_, weights_;  // inner nodes; weights of all, the ends included
  mutable Kinematics k_;
  State<double> start_, now_;
  std::vector<double> power_now_;
};

}  // namespace twinarm
