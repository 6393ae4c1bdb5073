// `twinarm coupling predict` and `twinarm coupling gains`.
#include <fmt/format.h>
#include <algorithm>
#include <numbers>

#include "app/command/command.h"
#include "app/coupling/prediction.h"
#include "app/data/value.h"
#include "app/support/files.h"
#include "app/support/text.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

struct CouplingPredictOptions {
  RobotOptions robot;  // model: a scene, or a URDF and one coupling from the options below
  std::string type = "linear", link, point, measure,
              discretization;  // as in a scene; point "x,y,z"
  std::optional<double> stiffness, damping;
  std::optional<double> step;   // [s]; default: the scene's
  std::string integrator;       // empty: the scene's
  double move = 180, time = 1;  // move of the target [deg, or mm], [s]
  std::optional<double> wall;   // [N/m]
  std::string along;            // "j1=1,j2=-0.5": factors of that move; empty: 1 for each joint
  bool json = false;
};

void add_options(const OptionAdder& add, CouplingPredictOptions& options) {
  add.robot(options.robot, "scene (TOML) with couplings; or URDF with --link and --stiffness");
  add.group("Coupling of a URDF");
  add("--type", options.type, "type of the coupling, as in a scene");
  add("--link", options.link, "link on which the coupling acts");
  add("--point", options.point, "point x,y,z in link axes [m]; default 0,0,0");
  add("--measure", options.measure, "torsional coupling: world or joint");
  add("--discretization", options.discretization,
      "discretization: explicit, semi-implicit or implicit");
  add("--stiffness", options.stiffness, "stiffness [N/m or N m/rad]");
  add("--damping", options.damping, "damping [N s/m or N m s/rad]");
  add.group("Prediction");
  add.scene_step(options.step, options.integrator);
  add("--move", options.move, "move of the target [deg, or mm]")->check(above_zero());
  add("--time", options.time, "duration of the move [s]")->check(above_zero(1e4));
  add("--along", options.along,
      "joint=factor,..: factor of the move for each joint; default: 1 for all");
  add("--wall", options.wall, "stiffness of a wall that the robot touches [N/m]")
      ->check(above_zero());
  add.group("Output");
  add.json(options.json);
}

struct CouplingGainsOptions {
  RobotOptions robot;  // model: a scene; empty: gains from the options below
  std::optional<double> frequency, damping_ratio;  // [Hz], 1
  std::optional<double> stiffness, inertia;
  double damping = 0;
  std::string solref, impedance;  // "a,b"; "d" or "d,dmax"
  bool json = false;
};

void add_options(const OptionAdder& add, CouplingGainsOptions& options) {
  add.group("Scene");
  add.input("model", options.robot.model, ".toml",
            "scene (TOML) with couplings; default: gains from the options below");
  add.input("--state", options.robot.state, "", "state file (JSON): q [rad, m]");
  add.group("Gains");
  add("--frequency", options.frequency, "natural frequency [Hz]")->check(above_zero());
  add("--damping-ratio", options.damping_ratio, "damping ratio")->check(zero_or_more());
  add("--inertia", options.inertia, "inertia that the spring moves, without a scene [kg or kg m^2]")
      ->check(above_zero());
  add("--stiffness", options.stiffness, "stiffness, without a scene [N/m or N m/rad]")
      ->check(above_zero());
  add("--damping", options.damping, "damping, without a scene [N s/m or N m s/rad]")
      ->check(zero_or_more());
  add("--solref", options.solref,
      "MuJoCo solref, without a scene: timeconst,dampratio or -stiffness,-damping");
  add("--impedance", options.impedance, "MuJoCo impedance d, or d,dmax; default 0.95");
  add.group("Output");
  add.json(options.json);
}

// "joint1=1,joint2=-0.5"
std::vector<std::pair<std::string, double>> read_along(const std::string& text,
                                                       DiagnosticList& faults) {
  std::vector<std::pair<std::string, double>> factors;
  if (text.empty()) return factors;
  for (const std::string& item : split(text)) {
    const std::size_t at = std::min(item.find('='), item.size());
    if (const auto factor = parse_number(item.substr(std::min(at + 1, item.size()))))
      factors.emplace_back(item.substr(0, at), *factor);
    else
      faults.add("--along", "'" + item + "' is not joint=number", "give joint1=1,joint2=-0.5",
                 "option.form");
  }
  return factors;
}

// Prepares a scene with couplings: the file, or `scene` in its place.
SimulatePlan prepare_couplings(const RobotOptions& robot, const std::optional<double>& step,
                               const std::string& integrator, DiagnosticList& faults,
                               std::optional<Value> scene = {}) {
  if (robot.model.extension() != ".toml" && !scene)
    faults.add({robot.model.string(), 0, "", "is not a scene; only a scene has couplings",
                "write a scene with a [[robot]] and a [[coupling]] "
                "(docs/reference/scene_file.md), or give `coupling predict` --link and --stiffness",
                "file.no-scene"});
  faults.check();
  SimulateOptions simulate;
  simulate.scene = std::move(scene);
  simulate.robot = robot;
  simulate.duration = 1;
  simulate.step = step;
  simulate.integrator = integrator;
  SimulatePlan prepared = prepare_simulation(simulate);
  if (prepared.input.couplings->size() == 0)
    throw InputError({{robot.model.string(), 0, "scene", "it has no coupling",
                       "add a [[coupling]] (docs/reference/scene_file.md)", "scene.no-coupling"}});
  return prepared;
}

// The scene of one robot and one coupling that the options describe; its values are checked by the
// reader of scenes.
Value scene_of_options(const CouplingPredictOptions& options, DiagnosticList& faults) {
  const std::string model = std::filesystem::absolute(options.robot.model).string();
  const Value robot = Value::table({{"name", Value::of("robot")}, {"model", Value::of(model)}});
  Value coupling = Value::table({{"name", Value::of("coupling")}});
  for (const auto& [key, words] : {std::pair{"type", &options.type},
                                   {"link", &options.link},
                                   {"measure", &options.measure},
                                   {"discretization", &options.discretization}})
    if (!words->empty()) coupling.put(key, Value::of(*words));
  for (const auto& [key, size] :
       {std::pair{"stiffness", &options.stiffness}, {"damping", &options.damping}})
    if (*size) coupling.put(key, Value::of(**size));
  if (!options.point.empty())
    coupling.put("point", Value::numbers(parse_list("--point", options.point, faults)));
  return Value::table({{"robot", Value::list({robot})}, {"coupling", Value::list({coupling})}});
}

int run_coupling_predict(const CouplingPredictOptions& options) {
  DiagnosticList faults;
  const auto along = read_along(options.along, faults);
  const bool is_scene = options.robot.model.extension() == ".toml";
  const bool has_coupling = options.stiffness || options.damping || !options.link.empty() ||
                            !options.point.empty() || !options.measure.empty() ||
                            !options.discretization.empty();
  if (is_scene && has_coupling)
    faults.add("--link, --point, --measure, --discretization, --stiffness, --damping",
               "apply to a URDF only", "change the scene's [[coupling]]", "option.useless");
  std::optional<Value> scene;
  if (!is_scene && has_coupling) scene = scene_of_options(options, faults);
  SimulatePlan prepared =
      prepare_couplings(options.robot, options.step, options.integrator, faults, std::move(scene));
  const PredictTask task{options.move * std::numbers::pi / 180, options.time, options.wall, along};
  const Predicted found = predict_couplings(prepared, task);
  print_warnings(found.warnings, options.json);
  fmt::print("{}\n", options.json ? predicted_json(found, task) : predicted_table(found, task));
  return 0;
}

struct GivenGains {
  std::optional<SpringResponse> response;  // --frequency, --damping-ratio
  std::optional<Solref> solref;
  MujocoImpedance impedance;
};

GivenGains read_given_gains(const CouplingGainsOptions& options, DiagnosticList& faults) {
  GivenGains given;
  if (options.frequency.has_value() != options.damping_ratio.has_value()) {
    faults.add("--frequency, --damping-ratio", "one is given without the other",
               "give both, or neither", "option.together");
  } else if (options.frequency) {
    given.response = {2 * std::numbers::pi * *options.frequency, *options.damping_ratio};
  }
  if (!options.solref.empty()) {
    const std::vector<double> two = parse_list("--solref", options.solref, faults);
    if (two.size() == 2 && ((two[0] > 0 && two[1] > 0) || (two[0] <= 0 && two[1] <= 0)))
      given.solref = {two[0], two[1]};
    else
      faults.add("--solref", "'" + options.solref + "' is not a solref",
                 "give timeconst,dampratio, both positive, or -stiffness,-damping", "option.form");
  }
  if (!options.impedance.empty()) {
    const std::vector<double> d = parse_list("--impedance", options.impedance, faults);
    const auto fits = [](double value) { return value > 0 && value < 1; };
    if (!d.empty() && d.size() <= 2 && std::ranges::all_of(d, fits))
      given.impedance = {d.front(), d.back()};
    else
      faults.add("--impedance", "'" + options.impedance + "' is not an impedance",
                 "give d, or d,dmax, each above 0 and below 1", "option.form");
  }
  return given;
}

// Without a scene: from an inertia and gains in one of three forms.
Equivalents bare_equivalents(const CouplingGainsOptions& options, const GivenGains& given,
                             DiagnosticList& faults) {
  const int ways = (options.stiffness ? 1 : 0) + (given.response ? 1 : 0) + (given.solref ? 1 : 0);
  const bool is_bare = !options.inertia && ways == 0 && faults.empty();
  if (is_bare)
    faults.add("command line", "no scene and no gains are given",
               "give SCENE.toml, or --inertia with --stiffness, --frequency or --solref",
               "option.missing");
  else if (!options.inertia)
    faults.add("--inertia", "is needed without a scene",
               "give the inertia that the spring moves [kg or kg m^2], or a scene",
               "option.missing");
  if (ways != 1 && !is_bare)
    faults.add("gains", ways == 0 ? "are missing" : "are given in more than one form",
               "give one of --stiffness and --damping, --frequency and --damping-ratio, --solref",
               "option.conflict");
  faults.check();
  const SpringGains gains = given.response ? gains_of(*given.response, *options.inertia)
                            : given.solref
                                ? gains_of(*given.solref, *options.inertia, given.impedance)
                                : SpringGains{*options.stiffness, options.damping};
  return equivalents_of(gains, *options.inertia, given.impedance);
}

int run_coupling_gains(const CouplingGainsOptions& options) {
  DiagnosticList faults;
  const GivenGains given = read_given_gains(options, faults);
  std::vector<Equivalents> all;
  double step = 0.001;
  if (options.robot.model.empty()) {
    all.push_back(bare_equivalents(options, given, faults));
  } else {
    if (options.stiffness || options.inertia || given.solref)
      faults.add("--stiffness, --inertia, --solref", "apply to gains without a scene only",
                 "leave out the scene, or these", "option.useless");
    SimulatePlan prepared = prepare_couplings(options.robot, {}, "semi-implicit", faults);
    step = prepared.run.step;
    all = scene_equivalents(prepared.input, given.response, given.impedance);
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
      "Predict stability limits, modes and tracking error of couplings; convert gains\n\n"
      "Examples:\n"
      "  twinarm coupling predict assets/scenes/robot_beside_obstacles.toml\n"
      "  twinarm coupling gains --inertia 0.5 --frequency 8 --damping-ratio 1",
      {{10, "predict",
        "Predict joint-space stiffness, modes, the largest stable step and stiffness, tracking "
        "error and static deflection of couplings\n\n"
        "Examples:\n"
        "  twinarm coupling predict assets/scenes/robot_beside_obstacles.toml --step 0.004\n"
        "  twinarm coupling predict assets/robots/s103/s103.urdf --link gripper --stiffness 500",
        add_options, run_coupling_predict},
       {20, "gains",
        "Convert gains between stiffness and damping, frequency and damping ratio, MuJoCo "
        "solref and PhysX drive\n\n"
        "Examples:\n"
        "  twinarm coupling gains --inertia 0.5 --frequency 8 --damping-ratio 1\n"
        "  twinarm coupling gains assets/scenes/robot_beside_obstacles.toml",
        add_options, run_coupling_gains}}};
}

}  // namespace twinarm
