// Dormand and Prince's Runge-Kutta pair 5(4) with steps chosen so that the error estimate stays
// within a tolerance (Hairer, Norsett, Wanner, Solving ODEs I, II.4 and II.5).
//
// The estimate of the error of one substep is h sum_s e_s k_s, e the difference of the weights of
// the two methods, in theta (the group's algebra) and in velocity. With y either of them,
//   err = max_i |error_i| / (tolerance + tolerance max(|y_i|, |y'_i|)),
// and a substep is accepted where err <= 1. The next substep is h times
//   0.9 err^(-0.17) err_before^(0.04)
// (a PI controller), between 1/5 and 10. The last stage of a substep is the first of the next, but
// where joints have Coulomb friction: there a substep ends where its kind changes
// (friction_events.h).
#pragma once

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
  void serialize(StateArchive& memory) {
    memory.visit(h_next_);
    memory.visit(err_before_);
  }
  void forget() { h_next_ = 0; }  // the substep that the past recommends

  // Moves m.x, its time too, by h in as many substeps as it needs; or, with `one`, by one accepted
  // substep of at most h. m.k is left to the caller. The sources' step is the whole of h.
  void step(IntegrationState& m, double h, bool one, StepReport& report);

 private:
  void stages(IntegrationState& m, double h);  // m.stage: where they lead
  double up_to_event(IntegrationState& m, double h, StepReport& report);
  void accept(IntegrationState& m, double t);
  double error(const IntegrationState& m, double h);
  double scaled(double error, double y, double y_new) const;
  double first_substep(IntegrationState& m, double h_max);
  void choose_next(double h, bool whole);

  RungeKutta rk_;
  FrictionEventFunction margin_;
  double tolerance_ = 1e-9;
  double h_next_ = 0;                    // 0: none known
  double err_ = 0, err_before_ = 1e-4;   // of the last attempt, of the last accepted one
  bool rejected_ = false;                // the last attempt
  std::vector<double> size_, size_new_;  // of the coordinates, by velocity
};

}  // namespace twinarm
