// Dormand-Prince 5(4) with adaptive substeps (Hairer, Norsett, Wanner, Solving ODEs I, II.4, II.5).
//
// Error estimate of a substep: h sum_s e_s k_s, e the difference of the weights of the two methods,
// for theta (Lie algebra) and velocity. With y either of them,
//   err = max_i |error_i| / (tolerance + tolerance max(|y_i|, |y'_i|));
// a substep is accepted if err <= 1. PI controller: the next substep is h times
//   0.9 err^(-0.17) err_before^(0.04),  limited to [1/5, 10].
// First same as last: the last stage is the first of the next substep, except with Coulomb friction
// in joints, where substeps end at friction events (friction_events.h).
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/integration/explicit_integrators.h"
#include "solver/integration/friction_events.h"
#include "solver/integration/step_report.h"
#include "solver/support/state_archive.h"

namespace twinarm {

class Dopri5 {
 public:
  explicit Dopri5(const IntegrationState& m);
  void set_tolerance(double tolerance) { tolerance_ = tolerance; }
  double tolerance() const { return tolerance_; }
  void serialize(StateArchive& archive) { archive.visit(h_next_, err_before_); }
  void reset_step_size() { h_next_ = 0; }

  // Advances m.x including time by h, or with `one` by one accepted substep of at most h. The
  // caller updates m.k. begin_step() of the sources got the whole h.
  void step(IntegrationState& m, double h, bool one, StepReport& report);

 private:
  // Result: m.stage.
  void stages(IntegrationState& m, double h) {
    const Tableau& tableau = tableau_of(Integrator::dopri5);
    for (int s = 1; s < tableau.stages; ++s) rk_.stage(m, tableau, s, h);
  }
  double up_to_event(IntegrationState& m, double h, StepReport& report);
  void accept(IntegrationState& m, double t);
  double error(const IntegrationState& m, double h);
  double scaled(double error, double y, double y_new) const {
    return std::abs(error) / (tolerance_ * (1 + std::max(std::abs(y), std::abs(y_new))));
  }
  double first_substep(IntegrationState& m, double h_max);
  void choose_next(double h, bool full);

  RungeKutta rk_;
  FrictionEventFunction margin_;
  double tolerance_ = 1e-9;
  double h_next_ = 0;                    // 0: undefined
  double err_ = 0, err_before_ = 1e-4;   // of the last attempt; of the last accepted one
  bool rejected_ = false;                // last attempt
  std::vector<double> size_, size_new_;  // of the coordinates, by velocity
};

}  // namespace twinarm
