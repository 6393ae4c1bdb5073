// `twinarm coupling predict` and `twinarm coupling gains`.
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <sstream>
#include <utility>

#include "app/command/command.h"
#include "app/command/parser/shared_options.h"
#include "app/coupling/gain_equivalents.h"
#include "app/coupling/prediction.h"
#include "app/data/value.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

struct CouplingPredictOptions {
  RobotOptions robot;  // its model: a scene; or a URDF, with one coupling in words
  std::string type = "linear", link, point, measure, treatment;  // as in a scene; point "x,y,z"
  std::optional<double> stiffness, damping;
  std::optional<double> step;   // [s]; left out: the scene's
  std::string integrator;       // empty: the scene's
  double turn = 180, time = 1;  // of the target [deg, or mm], [s]
  std::optional<double> wall;   // [N/m]
  std::string along;            // "j1=1,j2=-0.5": parts of that move; empty: 1 of each joint
  bool json = false;
};

void add_options(CLI::App& command, CouplingPredictOptions& options) {
  add_robot_options(command, options.robot,
                    "a scene in TOML, with couplings; or a URDF, with --link and --stiffness");
  command.add_option("--type", options.type, "of a URDF's coupling, as in a scene")
      ->capture_default_str();
  command.add_option("--link", options.link, "likewise: the link that is pulled");
  command.add_option("--point", options.point, "likewise: x,y,z in link axes [m]");
  command.add_option("--measure", options.measure, "likewise: world or joint");
  command.add_option("--treatment", options.treatment, "likewise");
  command.add_option("--stiffness", options.stiffness, "likewise [N/m or N m/rad]");
  command.add_option("--damping", options.damping, "likewise [N s/m or N m s/rad]");
  add_scene_step_options(command, options.step, options.integrator);
  command.add_option("--turn", options.turn, "how far the target goes [deg, or mm]")
      ->capture_default_str();
  command.add_option("--time", options.time, "in which time [s]")->capture_default_str();
  command.add_option("--along", options.along,
                     "joint=part,..: what part of it each joint goes; all of it if not given");
  command.add_option("--wall", options.wall, "stiffness of a wall in the way [N/m]");
  add_json_option(command, options.json);
}

struct CouplingGainsOptions {
  RobotOptions robot;  // its model: a scene; empty: gains from the options below
  std::optional<double> frequency, damping_ratio;  // [Hz], 1
  std::optional<double> stiffness, inertia;
  double damping = 0;
  std::string solref, impedance;  // "a,b"; "d" or "d,dmax"
  bool json = false;
};

void add_options(CLI::App& command, CouplingGainsOptions& options) {
  add_input_option(command, "model", options.robot.model,
                   "a scene in TOML, with couplings; may be left out");
  add_input_option(command, "--state", options.robot.state, "JSON file: q");
  command.add_option("--frequency", options.frequency, "wanted [Hz]");
  command.add_option("--damping-ratio", options.damping_ratio, "wanted");
  command.add_option("--inertia", options.inertia, "without a scene: what is moved [kg or kg m^2]");
  command.add_option("--stiffness", options.stiffness, "without a scene [N/m or N m/rad]");
  command.add_option("--damping", options.damping, "likewise [N s/m or N m s/rad]");
  command.add_option("--solref", options.solref,
                     "likewise, MuJoCo's timeconst,dampratio or -stiffness,-damping");
  command.add_option("--impedance", options.impedance, "MuJoCo's d, or d,dmax; 0.95 if not given");
  add_json_option(command, options.json);
}

void check_positive(const std::string& option, double value, DiagnosticList& faults) {
  if (value > 0 && std::isfinite(value)) return;
  faults.add(
      {"", 0, option, "must be positive, is " + number_text(value), "", "option.not-positive"});
}
void check_not_negative(const std::string& option, double value, DiagnosticList& faults) {
  if (value >= 0 && std::isfinite(value)) return;
  faults.add(
      {"", 0, option, "must not be negative, is " + number_text(value), "", "option.negative"});
}

// "joint1=1,joint2=-0.5"
std::vector<std::pair<std::string, double>> read_along(const std::string& text,
                                                       DiagnosticList& faults) {
  std::vector<std::pair<std::string, double>> parts;
  std::istringstream all(text);
  for (std::string one; std::getline(all, one, ',');) {
    const std::size_t at = one.find('=');
    const std::string value = at == std::string::npos ? "" : one.substr(at + 1);
    char* end = nullptr;
    const double part = std::strtod(value.c_str(), &end);
    if (value.empty() || *end != 0 || !std::isfinite(part))
      faults.add({"", 0, "--along", "'" + one + "' is not joint=number",
                  "give joint1=1,joint2=-0.5", "option.form"});
    else
      parts.emplace_back(one.substr(0, at), part);
  }
  return parts;
}

// A scene that has couplings, and its step; `scene` in place of a file.
SimulatePlan prepare_couplings(const RobotOptions& robot, const std::optional<double>& step,
                               const std::string& integrator, DiagnosticList& faults,
                               std::optional<Value> scene = {}) {
  if (robot.model.extension() != ".toml" && !scene)
    faults.add({robot.model.string(), 0, "", "is no scene, and only a scene has couplings",
                "write a scene with a [[robot]] and a [[coupling]] (docs/reference/scene_file.md); or give "
                "`coupling predict` --link and --stiffness",
                "file.no-scene"});
  faults.check();
  SimulateOptions simulate;
  simulate.scene = std::move(scene);
  simulate.robot = robot;
  simulate.duration = 1;
  simulate.step = step;
  simulate.integrator = integrator;
  auto prepared = attempt(faults, [&] { return prepare_simulation(simulate); });
  faults.check();
  if (prepared->input.couplings->size() == 0)
    throw InputError({{robot.model.string(), 0, "scene", "it has no coupling",
                       "write a [[coupling]] (docs/reference/scene_file.md)", "scene.no-coupling"}});
  return std::move(*prepared);
}

// The tree that such a scene file would have, of one robot and one coupling; its values are checked
// where scenes are read.
Value scene_of_options(const CouplingPredictOptions& options, DiagnosticList& faults) {
  Value robot, coupling, scene;
  robot.put("name", Value::of("robot"));
  robot.put("model", Value::of(std::filesystem::absolute(options.robot.model).string()));
  coupling.put("name", Value::of("coupling"));
  for (const auto& [key, words] : {std::pair{"type", &options.type},
                                   {"link", &options.link},
                                   {"measure", &options.measure},
                                   {"treatment", &options.treatment}})
    if (!words->empty()) coupling.put(key, Value::of(*words));
  for (const auto& [key, size] :
       {std::pair{"stiffness", &options.stiffness}, {"damping", &options.damping}})
    if (*size) coupling.put(key, Value::of(**size));
  if (!options.point.empty()) {
    Value& point = coupling.put("point", Value::list({}));
    for (const double x : parse_list("--point", options.point, faults))
      point.items.push_back(Value::of(x));
  }
  scene.put("robot", Value::list({std::move(robot)}));
  scene.put("coupling", Value::list({std::move(coupling)}));
  return scene;
}

int run_coupling_predict(const CouplingPredictOptions& options) {
  DiagnosticList faults;
  check_positive("--turn", options.turn, faults);
  check_positive("--time", options.time, faults);
  if (options.wall) check_positive("--wall", *options.wall, faults);
  const auto along = read_along(options.along, faults);
  const bool is_scene = options.robot.model.extension() == ".toml";
  const bool has_coupling = options.stiffness || options.damping || !options.link.empty() ||
                            !options.point.empty() || !options.measure.empty() ||
                            !options.treatment.empty();
  if (is_scene && has_coupling)
    faults.add({"", 0, "--link, --point, --measure, --treatment, --stiffness, --damping",
                "are for a robot without a scene", "change the scene's [[coupling]]",
                "option.useless"});
  std::optional<Value> scene;
  if (!is_scene && has_coupling) scene = scene_of_options(options, faults);
  SimulatePlan prepared =
      prepare_couplings(options.robot, options.step, options.integrator, faults, std::move(scene));
  const PredictTask task{options.turn * std::numbers::pi / 180, options.time, options.wall, along};
  const Predicted found = predict_couplings(prepared, task);
  fmt::print("{}\n", options.json ? predicted_json(found, task) : predicted_table(found, task));
  return 0;
}

struct GivenGains {
  std::optional<SpringResponse> response;  // --frequency, --damping-ratio
  std::optional<Solref> solref;
  MujocoImpedance impedance;
};

GivenGains read_given_gains(const CouplingGainsOptions& options, DiagnosticList& faults) {
  GivenGains asked;
  if (options.frequency.has_value() != options.damping_ratio.has_value()) {
    faults.add({"", 0, "--frequency, --damping-ratio", "go together", "give both, or neither",
                "option.together"});
  } else if (options.frequency) {
    check_positive("--frequency", *options.frequency, faults);
    check_not_negative("--damping-ratio", *options.damping_ratio, faults);
    asked.response = {2 * std::numbers::pi * *options.frequency, *options.damping_ratio};
  }
  if (!options.solref.empty()) {
    const std::vector<double> two = parse_list("--solref", options.solref, faults);
    if (two.size() == 2 && ((two[0] > 0 && two[1] > 0) || (two[0] <= 0 && two[1] <= 0)))
      asked.solref = {two[0], two[1]};
    else
      faults.add({"", 0, "--solref", "'" + options.solref + "' is no solref",
                  "give timeconst,dampratio, both positive, or -stiffness,-damping",
                  "option.form"});
  }
  if (!options.impedance.empty()) {
    const std::vector<double> d = parse_list("--impedance", options.impedance, faults);
    const bool good = !d.empty() && d.size() <= 2 && d.front() > 0 && d.front() < 1 &&
                      d.back() > 0 && d.back() < 1;
    if (good)
      asked.impedance = {d.front(), d.back()};
    else
      faults.add({"", 0, "--impedance", "'" + options.impedance + "' is none",
                  "give d, or d,dmax, each above 0 and below 1", "option.form"});
  }
  return asked;
}

// Without a scene: an inertia, and gains in one of four ways.
Equivalents bare_equivalents(const CouplingGainsOptions& options, const GivenGains& asked,
                             DiagnosticList& faults) {
  const int ways = (options.stiffness ? 1 : 0) + (asked.response ? 1 : 0) + (asked.solref ? 1 : 0);
  if (!options.inertia)
    faults.add({"", 0, "--inertia", "is needed where there is no scene",
                "give what the spring moves [kg or kg m^2], or a scene", "option.missing"});
  else
    check_positive("--inertia", *options.inertia, faults);
  if (ways != 1)
    faults.add({"", 0, "gains", fmt::format("are given in {} ways", ways),
                "give one of --stiffness and --damping, --frequency and --damping-ratio, --solref",
                "option.conflict"});
  if (options.stiffness) check_positive("--stiffness", *options.stiffness, faults);
  check_not_negative("--damping", options.damping, faults);
  faults.check();
  const SpringGains gains = asked.response ? gains_of(*asked.response, *options.inertia)
                            : asked.solref
                                ? gains_of(*asked.solref, *options.inertia, asked.impedance)
                                : SpringGains{*options.stiffness, options.damping};
  return equivalents_of(gains, *options.inertia, asked.impedance);
}

int run_coupling_gains(const CouplingGainsOptions& options) {
  DiagnosticList faults;
  const GivenGains asked = read_given_gains(options, faults);
  std::vector<Equivalents> all;
  double step = 0.001;
  if (options.robot.model.empty()) {
    all.push_back(bare_equivalents(options, asked, faults));
  } else {
    if (options.stiffness || options.inertia || asked.solref)
      faults.add({"", 0, "--stiffness, --inertia, --solref", "are for gains without a scene",
                  "leave the scene out, or these", "option.useless"});
    SimulatePlan prepared = prepare_couplings(options.robot, {}, "semi-implicit", faults);
    step = prepared.run.step;
    all = scene_equivalents(prepared.input, asked.response, asked.impedance);
    if (all.empty())
      throw InputError(
          {{options.robot.model.string(), 0, "scene", "none of its couplings has a stiffness",
            "give one", "scene.no-stiffness"}});
  }
  fmt::print("{}\n", options.json ? equivalents_json(all) : equivalents_table(all, step));
  return 0;
}

}  // namespace

Command coupling_command() {
  return {
      50,
      "coupling",
      "What theory says of a scene's couplings before it is run\n\n"
      "Example:  twinarm coupling predict assets/scenes/robot_beside_obstacles.toml",
      {{10, "predict",
        "Stiffness, modes, limits of step and stiffness, errors behind a moving target, sag\n\n"
        "Example:  twinarm coupling predict assets/scenes/robot_beside_obstacles.toml --step 0.004",
        add_options, run_coupling_predict},
       {20, "gains",
        "The same gains as a frequency, as a torsional coupling, in MuJoCo and as a PhysX drive\n\n"
        "Example:  twinarm coupling gains --inertia 0.5 --frequency 8 --damping-ratio 1",
        add_options, run_coupling_gains}}};
}

}  // namespace twinarm
