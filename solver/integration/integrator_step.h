// A step without constraints, by any of the integrators (integrator.h).
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
  void forget() { dopri5_.forget(); }  // the state is not where the last step led
  void serialize(StateArchive& memory) { dopri5_.serialize(memory); }

  // Moves m.x by h, its time too, and begins the step for the sources of forces; m.k is left to the
  // caller. `one_substep`: dopri5 takes one, of the size that its tolerance asks for.
  void step(IntegrationState& m, double h, bool one_substep, StepReport& report);

 private:
  void move(IntegrationState& m, double h, StepReport& report);  // a fixed size, not semi-implicit

  Integrator integrator_ = Integrator::semi_implicit;
  std::vector<double> shift_;
  RungeKutta rk_;
  Dopri5 dopri5_;
  FrictionEventLocator events_;
  std::optional<ImplicitStep> implicit_;  // nv x nv numbers: only where the integrator needs it
};

// The first number of the step that is not finite, if there is one, into the report.
void report_non_finite(const IntegrationState& m, StepReport& report);

}  // namespace twinarm
