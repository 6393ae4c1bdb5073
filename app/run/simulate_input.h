// Options and plan of a simulation of a robot (URDF) or a scene.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/data/value.h"
#include "app/robot/dynamics.h"
#include "app/scene/forces/scene_couplings.h"
#include "app/scene/model/scene_model.h"
#include "solver/integration/integrator.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// Options on which the results of a run depend. Defaults: the scene's; else 0.001 s, semi-implicit.
struct RunSettings {
  RobotOptions robot;
  std::optional<double> duration, step;  // [s]
  std::optional<double> tolerance;       // of dopri5, relative and absolute
  std::optional<double> energy_bound;    // of kinetic energy [J]; default: RunPlan::energy_bound
  std::string integrator;                // as in solver/integration/integrator.h; may be empty
  std::string contact;                   // "rigid" ..; may be empty
  // Of the contact solver [1/s], and with it an accuracy of 1e-4 m/s; each unless the scene sets
  // it.
  std::optional<double> budget;
};

struct SimulateOptions : RunSettings {
  std::optional<double> every;  // output interval [s]
  std::string at;               // output times "t1,t2,.." [s]
  bool json = false, csv = false;
  bool forces = false;                 // with accelerations, reactions and forces
  std::filesystem::path record;        // recording; may be empty
  std::optional<double> record_every;  // [s]; default: each step
  std::filesystem::path post_mortem;   // recording of a diverged run; empty: in out/
  std::function<void(Value&, DiagnosticList&)> change_scene;  // before it is read; may be empty
  std::optional<Value> scene;                                 // instead of the file robot.model
  bool has_operator = false;                                  // an input device is connected
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
  double step = 0;  // dopri5: the longest substep
  bool step_is_given = false;
  double tolerance = 1e-9;
  bool locates_events = false;
  std::vector<double> times;  // of samples, ascending
  // The run stops if its kinetic energy exceeds this. Negative: kGrowth times the maximum of 1 J,
  // the kinetic energy at the start, and the weight times 1 m; once an energy alarm has been
  // raised, kGrowthAfterAlarm times this.
  double energy_bound = -1;  // [J]
  static constexpr double kGrowth = 1e12, kGrowthAfterAlarm = 1e4;
  bool is_adaptive() const { return integrator == Integrator::dopri5; }
};

RunPlan plan_run(const SimulateOptions& options, const RunDefaults& defaults,
                 DiagnosticList& faults);

struct SimulateInput {
  RobotInput robot;                           // of a scene: joints of all robots, start state
  std::unique_ptr<SceneModel> scene;          // null for a URDF
  std::unique_ptr<SceneCouplings> couplings;  // null for a URDF
};

struct SimulatePlan {
  SimulateInput input;
  RunPlan run;
};

// The scene's file, or `scene`, with the changes of `robot`. Throws InputError.
Value scene_tree(const SimulateOptions& options, DiagnosticList& faults);

// Reads the robot or the scene and plans the run. Throws InputError with all diagnostics.
SimulatePlan prepare_simulation(const SimulateOptions& options);

}  // namespace twinarm
