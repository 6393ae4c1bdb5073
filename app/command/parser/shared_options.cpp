#include "app/command/parser/shared_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/robot/robot_input.h"
#include "app/support/files.h"
#include "app/support/text.h"
#include "solver/integration/integrator.h"

namespace twinarm {
namespace {

CLI::Option* reject_empty(CLI::Option* option) {
  const auto fault = [](const std::string& name) {
    return name.empty() ? std::string("the name of a file is empty") : std::string();
  };
  return option->type_name(kFileWord)->check(CLI::Validator(fault, ""));
}

}  // namespace

void begin_group(CLI::App& command, const char* heading) {
  command.option_defaults()->group(heading)->always_capture_default();
}

CLI::Option* add_file_option(CLI::App& command, const char* name, std::filesystem::path& file,
                             const char* help) {
  return reject_empty(command.add_option(name, file, help));
}

CLI::Option* add_file_option(CLI::App& command, const char* name,
                             std::vector<std::filesystem::path>& files, const char* help) {
  return reject_empty(command.add_option(name, files, help));
}

CLI::Option* add_input_option(CLI::App& command, const char* name, std::filesystem::path& file,
                              const char* help) {
  const auto look_up = [](std::string& typed) {
    typed = find_input(typed).string();
    return std::string();
  };
  return add_file_option(command, name, file, help)->transform(CLI::Validator(look_up, ""));
}

CLI::Validator above_zero() {
  return CLI::PositiveNumber.description("above 0");
}
CLI::Validator zero_or_more() {
  return CLI::NonNegativeNumber.description("0 or more");
}
CLI::Validator between(int min, int max) {
  return CLI::Range(min, max).description(fmt::format("{} to {}", min, max));
}

void add_json_option(CLI::App& command, bool& json) {
  command.add_flag("--json", json, "print one JSON object on stdout");
}
void add_assets_option(CLI::App& command, std::filesystem::path& assets) {
  add_file_option(command, "--assets", assets,
                  "folder with robots and settings; default: beside the program");
}
void add_scene_step_options(CLI::App& command, std::optional<double>& step,
                            std::string& integrator) {
  command.add_option("--step", step, "step [s]; default: the scene's");
  command.add_option("--integrator", integrator,
                     "default: the scene's; one of: " + integrator_names());
}

std::string integrator_names() {
  return fmt::format("{}", fmt::join(names_of(all_integrators), ", "));
}

void add_robot_options(CLI::App& command, RobotOptions& options, const char* model) {
  begin_group(command, "Model");
  add_input_option(command, "model", options.model, model)->required();
  add_input_option(command, "--state", options.state,
                   "state file (JSON): q, qd, tau, qdd, base, wrenches; default: at rest, or the "
                   "scene's start");
  command.add_option("--gravity", options.gravity,
                     "x,y,z in world axes [m/s^2]; default: the scene's, or 0,0,-9.81");
  command.add_flag("--floating", options.floating,
                   "floating base: the root link is not fixed to the world (URDF)");
  command.add_flag_callback(
      "--no-friction", [&] { options.friction = false; }, "ignore joint damping and friction");
  command.add_flag_callback(
      "--no-armature", [&] { options.armature = false; }, "ignore rotor inertia (armature)");
  command.add_flag("--strict", options.strict, "reject physically inconsistent inertias (URDF)");
}

}  // namespace twinarm
