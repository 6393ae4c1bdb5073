// What `dynamics` and `simulate` are both given: a URDF, a state, gravity, and what to leave out.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/robot/coordinates.h"
#include "app/robot/state_file.h"
#include "collision/import/robot/file_search.h"
#include "collision/import/robot/robot_description.h"
#include "solver/model/model.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

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
RobotInput read_robot_input(const RobotOptions& options, FaultList faults = {});

// What f returns; nothing where it finds faults, which are added to the others.
template <class F>
auto attempt(FaultList& faults, F f) -> std::optional<decltype(f())> {
  try {
    return f();
  } catch (const InputError& error) {
    faults.add(error.faults());
    return std::nullopt;
  }
}

// --gravity; nothing, told, where it is not three numbers.
std::optional<Vector3> parse_gravity(const std::string& text, FaultList& faults);

// Numbers separated by commas, as options have them; adds a fault and returns nothing else.
std::vector<double> parse_list(const std::string& option, const std::string& text,
                               FaultList& faults);

}  // namespace twinarm
