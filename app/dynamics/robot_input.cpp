#include "app/dynamics/robot_input.h"

#include <optional>

#include "app/dynamics/json_tree.h"
#include "collision/import/number_text.h"
#include "collision/import/robot_model.h"
#include "collision/import/urdf.h"

namespace twinarm {
namespace {

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

std::optional<RobotDescription> read_model_file(const RobotOptions& options, FaultList& faults) {
  const std::filesystem::path& file = options.model;
  if (file.extension() == ".toml") {
    faults.add({file.string(), 0, "model", "scenes cannot be run yet", "give a robot's URDF"});
    return std::nullopt;
  }
  return attempt(faults, [&] {
    return read_urdf(file, {.geometry = UrdfOptions::Geometry::optional, .strict = options.strict});
  });
}

}  // namespace

std::vector<double> parse_list(const std::string& option, const std::string& text,
                               FaultList& faults) {
  std::vector<double> values;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    std::string item = text.substr(begin, end - begin);
    item.erase(0, item.find_first_not_of(' '));
    if (const auto space = item.find_last_not_of(' '); space != std::string::npos)
      item.erase(space + 1);
    if (const auto value = parse_number(item)) {
      values.push_back(*value);
    } else {
      faults.add({"", 0, option, "'" + item + "' is not a finite number",
                  "write numbers separated by commas"});
      return {};
    }
    begin = end + 1;
  }
  return values;
}

RobotInput read_robot_input(const RobotOptions& options, FaultList faults) {
  std::vector<double> gravity{0, 0, -9.81};
  if (!options.gravity.empty()) {
    gravity = parse_list("--gravity", options.gravity, faults);
    if (!gravity.empty() && gravity.size() != 3)
      faults.add({"", 0, "--gravity", "has " + std::to_string(gravity.size()) + " numbers",
                  "give three: --gravity 0,0,-9.81"});
  }
  std::optional<JsonValue> json;
  if (!options.state.empty()) json = attempt(faults, [&] { return read_json(options.state); });
  const auto robot = read_model_file(options, faults);
  if (!robot) faults.check();

  ModelOptions model_options;
  model_options.floating = options.floating;
  model_options.friction = options.friction;
  model_options.armature = options.armature;
  auto model = attempt(faults, [&] { return build_model(*robot, model_options); });
  if (!model) faults.check();
  if (gravity.size() == 3) model->gravity = {gravity[0], gravity[1], gravity[2]};

  const Coordinates coordinates(*model, options.floating);
  GivenState state = json ? read_state(*json, options.state, *robot, *model, coordinates, faults)
                          : default_state(*model, coordinates);
  faults.check();
  std::vector<std::string> warnings;
  for (const Fault& warning : robot->warnings) warnings.push_back(to_string(warning));
  warnings.insert(warnings.end(), state.warnings.begin(), state.warnings.end());
  return {*robot, std::move(*model), coordinates, std::move(state), std::move(warnings)};
}

}  // namespace twinarm
