#include "app/command/parser/shared_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/robot/robot_input.h"
#include "app/support/files.h"
#include "solver/integration/integrator.h"

namespace twinarm {
namespace {

// Said for all options at this one place: nothing would be read or written, and nobody told.
CLI::Option* refuse_empty(CLI::Option* option) {
  const auto fault = [](const std::string& name) {
    return name.empty() ? std::string("the name of a file is empty") : std::string();
  };
  return option->type_name(kFileWord)->check(CLI::Validator(fault, ""));
}

}  // namespace

CLI::Option* add_file_option(CLI::App& command, const char* name, std::filesystem::path& file,
                             const char* help) {
  return refuse_empty(command.add_option(name, file, help));
}

CLI::Option* add_file_option(CLI::App& command, const char* name,
                             std::vector<std::filesystem::path>& files, const char* help) {
  return refuse_empty(command.add_option(name, files, help));
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
CLI::Validator between(int least, int most) {
  return CLI::Range(least, most).description(fmt::format("{} to {}", least, most));
}

void add_json_option(CLI::App& command, bool& json) {
  command.add_flag("--json", json, "print one JSON object on stdout");
}
void add_assets_option(CLI::App& command, std::filesystem::path& assets) {
  add_file_option(command, "--assets", assets, "folder of robots and settings (found by itself)");
}
void add_scene_step_options(CLI::App& command, std::optional<double>& step,
                            std::string& integrator) {
  command.add_option("--step", step, "seconds; the scene's if not given");
  command.add_option("--integrator", integrator, "the scene's if not given");
}

std::string integrator_names() {
  std::string names;
  for (const IntegratorFacts& facts : all_integrators) names += std::string(" ") + facts.name;
  return names;
}

void add_robot_options(CLI::App& command, RobotOptions& options, const char* model) {
  add_input_option(command, "model", options.model, model)->required();
  add_input_option(command, "--state", options.state, "JSON file: q, qd, tau, qdd, base, wrenches");
  command.add_option("--gravity", options.gravity,
                     "x,y,z in world axes [m/s^2]; 0,0,-9.81 if not given");
  command.add_flag("--floating", options.floating, "the root link is free, not fixed to the world");
  command.add_flag_callback(
      "--no-friction", [&] { options.friction = false; }, "as if no joint had damping or friction");
  command.add_flag_callback(
      "--no-armature", [&] { options.armature = false; }, "as if no joint had a rotor's inertia");
  command.add_flag("--strict", options.strict, "refuse inertias that no body has");
}

}  // namespace twinarm
