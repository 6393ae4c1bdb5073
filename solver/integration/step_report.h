// What a step says about itself.
#pragma once

namespace twinarm {

struct StepReport {
  bool finite = true;
  // Implicit integrators: the equation of the step is solved to rounding. Semi-implicit: no source
  // asks for more rounds than there may be. Where false, the state is that of the last one.
  bool converged = true;
  bool reached = true;  // dopri5: where false, the state stands before the end of the step, as no
                        // substep however short met the tolerance
  int rounds = 1;       // of forces and ABA; more than one where a source asked for it
  int iterations = 0;   // implicit integrators: of Newton's method
  int substeps = 1, rejected = 0;  // dopri5: accepted, and tried in vain
  int events = 0;  // joints' friction: places within the step where its kind changed
  // Steps that locate their events (event_driven_step.h): false where there were too many in this
  // one, and what was left of it was taken as one step of fixed size.
  bool located = true;
  bool interrupted = false;  // likewise: the step was asked to end, and stands before its end
  double h = 0;              // by how much the time went on [s]
  double loop_position_error =
      0;  // the largest error of position of a loop, after the step [m, rad]
  // Where the first non-finite number stands, in the order in which the passes write; body 0 and
  // null where all is finite.
  int nonfinite_body = 0;
  const char* nonfinite_field = nullptr;

  static constexpr double kMaxOpen = 1e-8;  // that still counts as closed
  bool ok() const {
    return finite && converged && reached && located && loop_position_error <= kMaxOpen;
  }
};

}  // namespace twinarm
