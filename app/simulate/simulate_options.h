// What `twinarm simulate` is told, and the run that this asks for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/dynamics/robot_input.h"
#include "solver/fault.h"
#include "solver/integrator.h"

namespace twinarm {

struct SimulateOptions {
  RobotOptions robot;
  // Left out: as the scene says, else 0.001 s and semi-implicit; there is no other duration.
  std::optional<double> duration, step;  // [s]
  std::string integrator;                // by its name in solver/integrator.h; may be empty
  std::string contact;                   // "rigid" ..; may be empty
  std::optional<double> tolerance;       // of dopri5, relative and absolute
  std::optional<double> every;           // a sample each so many seconds
  std::string at;                        // samples at these times, "t1,t2,.."
  bool json = false, csv = false;
};

struct RunDefaults {
  std::optional<double> duration;
  double step = 0.001;
  Integrator integrator = Integrator::semi_implicit;
  bool locates_events = false;
};

struct RunPlan {
  Integrator integrator = Integrator::semi_implicit;
  double duration = 0;
  double step = 0;  // of dopri5 the longest substep
  bool step_is_given = false;
  double tolerance = 1e-9;
  bool locates_events = false;  // in each step
  std::vector<double> times;    // of samples, ascending
  bool is_adaptive() const { return integrator == Integrator::dopri5; }
};

// Adds all faults of the options to the list.
RunPlan plan_run(const SimulateOptions& options, const RunDefaults& defaults, FaultList& faults);

}  // namespace twinarm
