// What is simulated: a robot from a URDF, or a scene.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/data/value.h"
#include "app/robot/robot_input.h"
#include "app/scene/forces/scene_couplings.h"
#include "app/scene/model/scene_model.h"
#include "solver/integration/integrator.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// What `twinarm simulate` is told, and the run that this asks for.
struct SimulateOptions {
  RobotOptions robot;
  // Left out: as the scene says, else 0.001 s and semi-implicit; there is no other duration.
  std::optional<double> duration, step;  // [s]
  std::string integrator;           // by its name in solver/integration/integrator.h; may be empty
  std::string contact;              // "rigid" ..; may be empty
  std::optional<double> tolerance;  // of dopri5, relative and absolute
  std::optional<double> every;      // a sample each so many seconds
  std::string at;                   // samples at these times, "t1,t2,.."
  bool json = false, csv = false;
  std::filesystem::path record;        // a recording; empty: none is written
  std::optional<double> record_every;  // [s]; left out: each step
  std::optional<double> energy_bound;  // of kinetic energy [J]; left out: kGrowth times the start's
  std::filesystem::path post_mortem;   // of a run that stops; empty: beside others in out/
  // What a fork changes in a scene before it is read; may be empty.
  std::function<void(Value&, DiagnosticList&)> change_scene;
  std::optional<Value> scene;  // in place of the file that robot.model names
  bool has_hand = false;       // one is at hand for couplings that follow a device
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
  // A run stops where its kinetic energy passes this. Negative: kGrowth times the largest of 1 J,
  // its kinetic energy at the start, and its weight over 1 m.
  double energy_bound = -1;  // [J]
  static constexpr double kGrowth = 1e12;
  bool is_adaptive() const { return integrator == Integrator::dopri5; }
};

// Adds all faults of the options to the list.
RunPlan plan_run(const SimulateOptions& options, const RunDefaults& defaults,
                 DiagnosticList& faults);

struct SimulateInput {
  // Of a scene: the joints of all its robots, and the start that the state file has changed.
  RobotInput robot;
  std::unique_ptr<SceneModel> scene;          // null for a URDF
  std::unique_ptr<SceneCouplings> couplings;  // likewise
};

struct SimulatePlan {
  SimulateInput input;
  RunPlan run;
};

// Reads the robot or the scene and makes a plan of the options. Throws InputError with all faults.
SimulatePlan prepare_simulation(const SimulateOptions& options);

}  // namespace twinarm
