// Options and output of `twinarm inspect`: a JSON object or text pages.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/accounting/energy_balance.h"
#include "app/data/json_writer.h"
#include "app/data/tables.h"
#include "app/inspect/cross_checks.h"
#include "app/inspect/force_balance.h"
#include "app/inspect/inspection.h"
#include "app/robot/robot_input.h"
#include "app/run/simulate_input.h"
#include "solver/forces/force_source.h"
#include "solver/integration/integrator.h"
#include "solver/support/diagnostics.h"
#include "solver/support/state_archive.h"

namespace twinarm {

// Input of `twinarm inspect`: state and named forces of a robot or of a step of a scene.

// Velocities are those after impacts at the start of the step.
struct Inspected {
  State<double> x;
  std::vector<AppliedForce> actors;
  std::vector<std::string> warnings;
  std::vector<double> qdd_of_step;  // of a scene, for the cross-check
  std::vector<LoopClosure> loops;   // of a scene
};

// Friction, mimic joints, given torques and wrenches at the state.
Inspected inspect_robot(const RobotInput& input);

// A force source besides those of the scene; added after its couplings.
struct NamedSource {
  std::string name;
  ForceSource* source;                          // Rewindable
  std::optional<std::pair<int, Vector3>> at{};  // body and point, link axes
};

// Forces of a semi-implicit step of h from an instant: given forces, couplings, contacts, limits,
// constraints. Built once for any number of instants; the input and the sources must outlive it,
// and look() changes the input's state.
class SceneInspector {
 public:
  // `of_run`: integrator of the run whose archives look() reads. It decides whether limits act and
  // whether free bodies are stepped with constraints.
  SceneInspector(SimulateInput& input, double h, const std::vector<NamedSource>& others = {},
                 Integrator of_run = Integrator::semi_implicit);
  ~SceneInspector();
  // From the archive of an instant of the run (Simulation::serialize, throws likewise); without
  // one, from the state of the last call or of the input. `x`: a state soon after that instant.
  Inspected look(StateArchive* memory = nullptr, const State<double>* x = nullptr);

 private:
  class FirstStep;
  std::unique_ptr<FirstStep> step_;
};

// Torques and wrenches of the state file, springs of a scene at x.
std::vector<AppliedForce> given_actors(const RobotInput& input, const State<double>& x);
// Adds a force "BEFORE joint AFTER" for each joint with nonzero tau (by velocity).
void add_by_joint(const Model<double>& model, const std::vector<double>& tau,
                  const std::string& before, const std::string& after,
                  std::vector<AppliedForce>& actors);

// What is shown.
struct InspectView {
  std::vector<int> passes{1, 2, 3};
  std::vector<std::size_t> bodies;               // in the order of the model
  Viewpoint from;                                // of wrenches
  std::string axes = "world", about = "origin";  // as typed
  std::vector<std::string> forces;               // sources that are shown
  bool forces_alone = false;                     // of --force: the text has only these forces
  std::string title;
  std::vector<EnergyRow> energy_balance;  // of a recording, up to its instant [J]
  std::vector<std::string> warnings;
};

struct InspectOptions {
  std::filesystem::path html;  // a page; empty: text on stdout
  RobotOptions robot;
  std::vector<std::string> passes, bodies;  // none: all
  std::string axes = "world";               // of the wrenches: world, link, or a body's name
  std::string about = "origin";             // origin, com, a body's name, or x,y,z in the world
  std::vector<std::string> forces;          // by name; none: all
  std::optional<double> step;               // of a scene [s]; default: the scene's
  std::optional<double> at;                 // of a recording [s]; default: its end
  bool json = false;
};

// --pass; all if none is given.
void read_passes(const InspectOptions& options, InspectView& view, DiagnosticList& faults);
// --body, --axes, --about.
void read_bodies(const InspectOptions& options, const Model<double>& model, InspectView& view,
                 DiagnosticList& faults);
// --force: the full name of a force, or its part after the first slash; the name of a contact
// selects all of its points.
void read_forces(const InspectOptions& options, const std::vector<AppliedForce>& actors,
                 InspectView& view, DiagnosticList& faults);

// Those that the view selects.
std::vector<NamedForce> forces_in_view(const Inspection& in, const InspectView& view);

// Accelerations of the inspected forces against those of the scene's step.
Check step_check(const Inspection& in, const std::vector<double>& qdd_of_step);
// Names the first quantity that is not finite.
void warn_of_bad_numbers(const Inspection& in, std::vector<std::string>& warnings);

// Members of the JSON object of `inspect --json`.
void write_inspection(JsonWriter& json, const Inspection& in, const InspectView& view,
                      const std::vector<Check>& checks);
// The list of "passes", in the order of aba().
void write_passes(JsonWriter& json, const Inspection& in, const std::vector<int>& passes,
                  const std::vector<std::size_t>& bodies);
// The list of "forces": those in view.
void write_forces(JsonWriter& json, const Inspection& in, const InspectView& view);
// A number, a list of numbers, a matrix by rows, or by columns (S, U: one for each velocity).
void write_value(JsonWriter& json, const Eigen::MatrixXd& m, bool by_columns);
void write_quantities(JsonWriter& json, const std::vector<DisplayedQuantity>& quantities);
std::string inspect_json(const Inspection& in, const InspectView& view,
                         const std::vector<Check>& checks);
std::string inspect_text(const Inspection& in, const InspectView& view,
                         const std::vector<Check>& checks);

// Wrenches on each body; named forces.
void write_balances(const Inspection& in, const InspectView& view, Sheet& sheet);
void write_named_forces(const Inspection& in, const InspectView& view, Sheet& sheet);

// Joint, parent and joint position of the body.
void write_body_head(const Inspection& in, std::size_t body, Sheet& sheet);
// Equations of a pass (1 to 3) from table 7.1 with their numbers, in the order of computation.
// `D_error`: of the cross-check of D.
void write_pass(const Inspection& in, int pass, std::size_t body, double D_error, Sheet& sheet);

}  // namespace twinarm
