// What `dynamics` and `simulate` are both given: a URDF, a state, gravity, and what to leave out.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/data/value.h"
#include "app/robot/coordinates.h"
#include "collision/import/robot/file_search.h"
#include "collision/import/robot/robot_description.h"
#include "solver/model/model.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// The state file: where a robot is, how it moves, what acts on it (docs/reference/state_file.md).

// A force at a point and a torque about that point, on a link.
struct Wrench {
  std::size_t body = 0;
  bool in_link_axes = false;  // else in world axes and coordinates
  Vector3 point = Vector3::Zero(), force = Vector3::Zero(), torque = Vector3::Zero();
};

struct GivenState {
  State<double> x;            // followers placed by their leaders
  Eigen::VectorXd tau, qdd;   // by rows of the mass matrix; of qdd the base's come first
  std::vector<bool> has_tau;  // by Coordinates::all(): whether the file names one
  std::vector<Wrench> wrenches;
  std::vector<std::string> warnings;
};

// Everything at rest at its identity.
GivenState default_state(const Model<double>& model, const Coordinates& coordinates);

// Adds all faults of the file to the list; what it returns is of use only if there are none. What
// the file leaves out is as in `start`.
GivenState read_state(const Value& json, const std::filesystem::path& file,
                      const RobotDescription& robot, const Model<double>& model,
                      const Coordinates& coordinates, const GivenState& start,
                      DiagnosticList& faults);

struct RobotOptions {
  std::filesystem::path model, state;  // state may be empty: at rest at the identity
  std::string gravity;                 // "x,y,z"; empty: 0,0,-9.81
  bool floating = false;
  bool friction = true, armature = true;
  bool strict = false;  // inertias that no body has are faults
  FileRoots roots;      // of the files that the model names
};

struct RobotInput {
  RobotDescription robot;
  Model<double> model;
  Coordinates coordinates;
  GivenState state;
  std::vector<std::string> warnings;
};

// Throws InputError with all faults: those given, and those of the options, the URDF and the state.
RobotInput read_robot_input(const RobotOptions& options, DiagnosticList faults = {});

// What f returns; nothing where it finds faults, which are added to the others.
template <class F>
auto attempt(DiagnosticList& faults, F f) -> std::optional<decltype(f())> {
  try {
    return f();
  } catch (const InputError& error) {
    faults.add(error.faults());
    return std::nullopt;
  }
}

// --gravity; nothing, told, where it is not three numbers.
std::optional<Vector3> parse_gravity(const std::string& text, DiagnosticList& faults);

// Numbers separated by commas, as options have them; adds a fault and returns nothing else.
std::vector<double> parse_list(const std::string& option, const std::string& text,
                               DiagnosticList& faults);

}  // namespace twinarm
