#include "app/command/parser/shared_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "app/robot/robot_input.h"
#include "app/support/files.h"
#include "app/support/text.h"
#include "solver/integration/integrator.h"
#include "solver/support/number_text.h"

namespace twinarm {

CLI::Option* OptionAdder::as_file(CLI::Option* option) {
  const auto fault = [](const std::string& name) {
    return name.empty() ? std::string("the name of a file is empty") : std::string();
  };
  return option->type_name(kFileWord)->check(CLI::Validator(fault, ""));
}

CLI::Option* OptionAdder::as_input(CLI::Option* option, const char* endings) const {
  const auto look_up = [](std::string& typed) {
    typed = find_input(typed).string();
    return std::string();
  };
  files->push_back({option, false, endings});
  return option->transform(CLI::Validator(look_up, ""));
}

CLI::Option* OptionAdder::output(const char* name, std::filesystem::path& file, const char* ending,
                                 const std::string& help) const {
  CLI::Option* option = (*this)(name, file, help);
  files->push_back({option, true, ending});
  return option;
}

namespace {
// Endings of files that the program reads or writes, and of other texts, pictures and videos.
constexpr std::string_view kEndings =
    ".toml .urdf .xacro .json .csv .twinrec .twinmap .html .svg .png .jpg .jpeg .gif .mp4 .webm "
    ".avi .pdf .stl .obj .ply .dae .gltf .glb .md .txt .py ";

// Whether it ends as another kind of file does.
bool is_other_kind(const std::filesystem::path& file, const std::string& endings) {
  const std::string kind = file.extension().string() + " ";
  return (endings + " ").find(kind) == std::string::npos && kEndings.find(kind) != kEndings.npos;
}

// `words`: the range, for help and errors.
template <class IsValid>
CLI::Validator number_that(const std::string& words, IsValid is_valid) {
  const auto fault = [=](const std::string& text) {
    const std::optional<double> value = parse_number(text);
    return value && is_valid(*value) ? "" : fmt::format("must be {}, is {}", words, text);
  };
  return CLI::Validator(fault, words);
}

}  // namespace

void check_input(const std::filesystem::path& file, const std::string& option,
                 const std::string& endings, const std::string& wanted) {
  std::error_code error;
  const bool is_empty = std::filesystem::file_size(file, error) == 0 && !error &&
                        file.extension() != ".twinrec";  // the reader of recordings reports it
  const std::string what = std::filesystem::is_directory(file, error) ? "a folder"
                           : is_empty                                 ? "an empty file"
                           : is_other_kind(file, endings)
                               ? "a " + file.extension().string() + " file"
                               : "";
  if (!what.empty() && !endings.empty())
    throw InputError(
        {{file.string(), 0, option, "is " + what, "give a " + wanted.substr(0, wanted.find(';')),
          what == "a folder" ? "file.is-folder" : "file.kind"}});
}

void check_files(const FileOptions& files) {
  DiagnosticList faults;
  std::vector<std::pair<std::string, std::filesystem::path>> taken;
  for (const FileOption& input : files)
    if (!input.is_output)
      for (const std::string& name : input.option->results()) {
        attempt(faults, [&] {
          check_input(name, input.option->get_name(), input.ending,
                      input.option->get_description());
        });
        taken.emplace_back(input.option->get_name(), name);
      }
  for (const FileOption& output : files) {
    if (!output.is_output || output.option->empty()) continue;
    const std::string option = output.option->get_name();
    const std::filesystem::path file = output.option->results().front();
    const auto fault = [&](const std::string& problem, const std::string& fix, const char* code) {
      faults.add({file.string(), 0, option, problem, fix, code});
    };
    const auto same = std::ranges::find_if(
        taken, [&](const auto& other) { return is_same_file(other.second, file); });
    if (file.string().starts_with("--"))
      faults.add(option, "has no value: '" + file.string() + "' is an option",
                 "give " + option + " NAME", "option.no-value");
    else if (same != taken.end())
      fault("is also the file of " + same->first, "give another name", "file.same");
    else if (output.ending.empty())
      attempt(faults, [&] { require_writable_folder(file, option.c_str()); });
    else if (is_other_kind(file, output.ending))
      fault("writes a " + output.ending + " file", "end the name in " + output.ending,
            "file.ending");
    else
      check_place(file, option.c_str(), faults);
    taken.emplace_back(option, file);
  }
  faults.check();
}

void OptionAdder::scene_step(std::optional<double>& step, std::string& integrator) const {
  (*this)("--step", step, "time step [s]; default: the scene's");
  (*this)("--integrator", integrator,
          "integration method; default: the scene's; one of: " + integrator_names());
}

void OptionAdder::robot(RobotOptions& options, const char* model) const {
  group("Model");
  input("model", options.model, kModelEndings, model)->required();
  input("--state", options.state, "",
        "state file (JSON): q, qd, tau, qdd, base, wrenches [rad, m, s, N]; default: at rest, or "
        "the scene's start");
  (*this)("--gravity", options.gravity,
          "x,y,z in world axes [m/s^2]; default: the scene's, or 0,0,-9.81");
  (*this)("--set", options.changes,
          "PATH=VALUE: change this parameter of the scene; may be repeated");
  (*this)("--floating", options.floating,
          "floating base: the root link is not fixed to the world (URDF)");
  command.add_flag_callback(
      "--no-friction", [&] { options.friction = false; }, "ignore joint damping and friction");
  command.add_flag_callback(
      "--no-armature", [&] { options.armature = false; }, "ignore rotor inertia (armature)");
  (*this)("--strict", options.strict, "reject physically inconsistent inertias (URDF)");
  (*this)(
      "--density", options.missing.density,
      "density [kg/m^3] that gives links without inertia one from their shapes (URDF); default: "
      "none");
  (*this)("--min-mass", options.missing.min_mass,
          "mass [kg] of links that still have none, as a small sphere (URDF); default: none");
}

CLI::Validator above_zero(double max) {
  return number_that("above 0" + (std::isinf(max) ? "" : fmt::format(", at most {}", max)),
                     [=](double value) { return value > 0 && value <= max; });
}
CLI::Validator zero_or_more() {
  return number_that("0 or more", [](double value) { return value >= 0; });
}
CLI::Validator between(int min, int max) {
  return number_that(fmt::format("{} to {}", min, max),
                     [=](double value) { return value >= min && value <= max; });
}

std::string integrator_names() {
  return fmt::format("{}", fmt::join(names_of(all_integrators), ", "));
}

}  // namespace twinarm
