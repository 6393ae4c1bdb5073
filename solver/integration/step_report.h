// Report of one step.
#pragma once

namespace twinarm {

struct StepReport {
  bool finite = true;
  // Implicit integrators: equation solved to rounding. With constraints: impulses found. If false,
  // the state is that of the last iteration.
  bool converged = true;
  bool reached = true;  // dopri5: false if the tolerance cannot be met; the state is at the last
                        // accepted substep, before the end of the step
  int iterations = 0;   // Newton iterations; event-driven steps: solved impulse problems
  int substeps = 1, rejected = 0;  // dopri5, event-driven steps: accepted and rejected substeps
  int events = 0;  // stick-slip transitions of joint friction; event-driven steps: all events
  // Event-driven steps: false if there were too many events and the remainder was one fixed step.
  bool located = true;
  bool interrupted = false;        // event-driven steps: ended early by the caller
  double h = 0;                    // time advanced [s]
  double loop_position_error = 0;  // maximum over the loops after the step [m, rad]
  // First non-finite variable in the order of computation (non_finite.h); 0 and null: all finite.
  int nonfinite_body = 0;
  const char* nonfinite_field = nullptr;

  static constexpr double kMaxLoopError = 1e-8;  // [m, rad]
  bool ok() const {
    return finite && converged && reached && located && loop_position_error <= kMaxLoopError;
  }
};

}  // namespace twinarm
