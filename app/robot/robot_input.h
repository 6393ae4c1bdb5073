// Input of `dynamics` and `simulate`: a URDF, a state, gravity, and effects to ignore.
#pragma once

#include "app/robot/coordinates.h"
#include "collision/import/robot/file_search.h"
#include "collision/import/robot/missing_inertia.h"
#include "solver/forces/point_springs.h"

namespace twinarm {

// A force at a point of a link and a torque about that point.
struct Wrench {
  std::size_t body = 0;
  bool in_link_axes = false;  // else world axes and coordinates
  Vector3 point = Vector3::Zero(), force = Vector3::Zero(), torque = Vector3::Zero();
};

// Contents of a state file (docs/reference/state_file.md).
struct GivenState {
  State<double> x;            // mimic joints included
  Eigen::VectorXd tau, qdd;   // by rows of the mass matrix; in qdd the base first
  std::vector<bool> has_tau;  // by Coordinates::all(): given in the file
  bool tau_varies = false;    // set between steps, by a controller
  std::vector<Wrench> wrenches;
  std::vector<std::string> warnings;
};

// At rest, with zero coordinates.
GivenState default_state(const Model<double>& model, const Coordinates& coordinates);

// Values that the file does not give are taken from `start`. The result is valid only if no
// diagnostic was added.
GivenState read_state(const Value& json, const std::filesystem::path& file,
                      const RobotDescription& robot, const Model<double>& model,
                      const Coordinates& coordinates, const GivenState& start,
                      DiagnosticList& faults);

struct RobotOptions {
  std::filesystem::path model, state;  // state may be empty
  std::string gravity;                 // "x,y,z"; empty: 0,0,-9.81
  std::vector<std::string> changes;    // of a scene: "coupling.stiffness=800"
  bool floating = false;
  bool friction = true, armature = true;
  bool strict = false;     // physically inconsistent inertias are errors
  bool kinematic = false;  // no dynamics is computed: joints that move no inertia are no error
  MissingInertia missing;
  FileRoots roots;  // folders that may contain the model's files
};

struct RobotInput {
  RobotDescription robot;
  Model<double> model;
  Coordinates coordinates;
  GivenState state;
  std::vector<std::string> warnings;
  std::vector<PointSpring> springs = {};  // of a scene
};

// Throws InputError with all diagnostics: given ones, and those of options, URDF and state.
RobotInput read_robot_input(const RobotOptions& options, DiagnosticList faults = {});

// Most velocities for which dense matrices of the whole system are made: they take O(n^2) memory,
// and O(n^3) time or more.
constexpr std::size_t kMaxDense = 1000;
// Throws InputError above.
void check_dense(const Model<double>& model, const std::filesystem::path& file);

// Adds a warning if gravity points up.
void add_gravity_warning(const Model<double>& model, std::vector<std::string>& warnings);

// --gravity: three numbers, or a diagnostic.
std::optional<Vector3> parse_gravity(const std::string& text, DiagnosticList& faults);

// Adds a diagnostic and returns false if the value is not positive and finite; `unit`: " [s]".
bool check_positive(const std::string& option, double value, DiagnosticList& faults,
                    const char* unit = "");

// Numbers separated by commas; empty, with a diagnostic, if one is not a number.
std::vector<double> parse_list(const std::string& option, const std::string& text,
                               DiagnosticList& faults);

}  // namespace twinarm
