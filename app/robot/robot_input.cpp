#include "app/robot/robot_input.h"

#include <optional>

#include "app/data/value.h"
#include "app/support/text_fields.h"
#include "collision/import/formats/robot_formats.h"
#include "collision/import/robot/robot_model.h"
#include "solver/dynamics/kinematics.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

std::optional<RobotDescription> read_model_file(const RobotOptions& options, FaultList& faults) {
  const std::filesystem::path& file = options.model;
  if (file.extension() == ".toml") {
    faults.add({file.string(), 0, "model", "a scene has no one state of one robot",
                "give a robot's URDF, or run the scene with `twinarm simulate`", "file.is-scene"});
    return std::nullopt;
  }
  if (file.extension() == ".twinrec") {
    faults.add({file.string(), 0, "model", "is a recording",
                "give a robot's URDF; `twinarm inspect` and `twinarm replay` open recordings",
                "file.is-recording"});
    return std::nullopt;
  }
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    faults.add({file.string(), 0, "model", "is a folder", "name the robot's URDF in it",
                "file.is-folder"});
    return std::nullopt;
  }
  return attempt(faults, [&] {
    return read_robot_file(file, {.geometry = RobotFileOptions::Geometry::optional,
                                  .strict = options.strict,
                                  .roots = options.roots});
  });
}

}  // namespace

std::vector<double> parse_list(const std::string& option, const std::string& text,
                               FaultList& faults) {
  std::vector<double> values;
  for (std::string item : split(text)) {
    item.erase(0, item.find_first_not_of(' '));
    if (const auto space = item.find_last_not_of(' '); space != std::string::npos)
      item.erase(space + 1);
    if (const auto value = parse_number(item)) {
      values.push_back(*value);
    } else {
      faults.add({"", 0, option, "'" + item + "' is not a finite number",
                  "write numbers separated by commas", "option.number"});
      return {};
    }
  }
  return values;
}

std::optional<Vector3> parse_gravity(const std::string& text, FaultList& faults) {
  const std::vector<double> numbers = parse_list("--gravity", text, faults);
  if (numbers.size() == 3) return Vector3(numbers.data());
  if (!numbers.empty())
    faults.add({"", 0, "--gravity", "has " + std::to_string(numbers.size()) + " numbers",
                "give three: --gravity 0,0,-9.81", "option.count"});
  return std::nullopt;
}

RobotInput read_robot_input(const RobotOptions& options, FaultList faults) {
  std::optional<Vector3> gravity;
  if (!options.gravity.empty()) gravity = parse_gravity(options.gravity, faults);
  std::optional<Value> json;
  if (!options.state.empty()) json = attempt(faults, [&] { return read_json(options.state); });
  const auto robot = read_model_file(options, faults);
  if (!robot) faults.check();

  ModelOptions model_options;
  model_options.floating = options.floating;
  model_options.friction = options.friction;
  model_options.armature = options.armature;
  auto model = attempt(faults, [&] { return build_model(*robot, model_options); });
  if (!model) faults.check();
  if (gravity) model->gravity = from_eigen(*gravity);

  const Coordinates coordinates(*model, options.floating);
  GivenState state = default_state(*model, coordinates);
  if (json) state = read_state(*json, options.state, *robot, *model, coordinates, state, faults);
  faults.check();
  std::vector<std::string> warnings;
  for (const Fault& warning : robot->warnings) warnings.push_back(to_string(warning));
  warnings.insert(warnings.end(), state.warnings.begin(), state.warnings.end());
  return {*robot, std::move(*model), coordinates, std::move(state), std::move(warnings)};
}

}  // namespace twinarm
