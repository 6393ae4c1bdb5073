// A step without contacts and limits, by any of the integrators (integrator.h).
#pragma once

#include <optional>
#include <vector>

#include "solver/integration/dopri5.h"
#include "solver/integration/explicit_integrators.h"
#include "solver/integration/friction_events.h"
#include "solver/integration/implicit_integrators.h"
#include "solver/integration/integrator.h"
#include "solver/integration/step_report.h"

namespace twinarm {

class IntegratorStep {
 public:
  explicit IntegratorStep(const IntegrationState& m);
  Integrator integrator() const { return integrator_; }
  void set_integrator(Integrator integrator, double tolerance);
  void reset_step_size() { dopri5_.reset_step_size(); }  // after a change of the state
  void serialize(StateArchive& archive) { dopri5_.serialize(archive); }

  // Advances m.x including time by h and calls begin_step() of the force sources; the caller
  // updates m.k. `one_substep`: dopri5 takes one substep by its tolerance.
  void step(IntegrationState& m, double h, bool one_substep, StepReport& report);

 private:
  // By integrators of fixed step size that are not semi-implicit.
  void smooth_step(IntegrationState& m, double h, StepReport& report);

  Integrator integrator_ = Integrator::semi_implicit;
  std::vector<double> delta_;
  RungeKutta rk_;
  Dopri5 dopri5_;
  FrictionEventLocator events_;
  std::optional<ImplicitStep> implicit_;  // allocated on use (nv x nv numbers)
};

// Reports the first non-finite number of the step, if any.
void report_non_finite(const IntegrationState& m, StepReport& report);

}  // namespace twinarm
