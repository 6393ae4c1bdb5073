#include "app/map/map_job.h"

#include <fmt/format.h>

#include "app/record/record_run.h"
#include "app/scene/read/change_scene.h"
#include "app/scene/read/scene_keys.h"
#include "app/support/text.h"

namespace twinarm {

namespace {

// Negative line numbers mark values from an axis.
constexpr int kLineOfX = -1, kLineOfY = -2;
constexpr double kMaxMapCells = 4.2e6, kMaxSteps = 1e8;  // of a map, of a cell

InputError attributed_to_axes(const InputError& error, const MapJob& job, double x, double y) {
  return error.changed([&](Diagnostic& fault) {
    if (fault.line != kLineOfX && fault.line != kLineOfY) return;
    const bool is_x = fault.line == kLineOfX;
    const std::string axis = is_x ? "--x " + job.x.path : "--y " + job.y.path;
    const std::string where = axis + " = " + number_text(is_x ? x : y);
    fault = {"", 0, where, fault.where + ": " + fault.problem, fault.fix, fault.code};
  });
}

// The measured coupling, and units.
void check_couplings(const SceneModel& scene, const std::string& of, MapJob& job,
                     DiagnosticList& faults) {
  const bool is_error =
      job.measure == MapMeasure::max_error || job.measure == MapMeasure::mean_error;
  const bool needs = is_error || job.measure == MapMeasure::passivity || !of.empty();
  job.error_unit = "rad";
  job.unit = is_error ? "rad" : job.measure == MapMeasure::stable ? "1" : "J";
  const std::string option = std::string("--measure ") + name_of(job.measure);
  if (needs && scene.couplings.empty())
    return faults.add({scene.description.file.string(), 0, option, "the scene has no coupling",
                       "measure stable or energy, or add a [[coupling]]", "map.no-coupling"});
  std::vector<std::string> names;
  for (const SceneCoupling& coupling : scene.couplings) names.push_back(coupling.coupling);
  if (!of.empty()) {
    const auto found = choose("--of", of, names, "couplings", faults, "map.coupling-unknown");
    if (!found) return;
    job.measured_coupling = *found;
  }
  const MeasuredJoints joints = measured_joints(scene, job.measured_coupling);
  if (joints.slide && !joints.turn) job.error_unit = "m";
  if (!is_error) return;
  job.unit = job.error_unit;
  if (joints.iq.empty() || (joints.slide && joints.turn))
    faults.add(option,
               joints.iq.empty() ? "the coupling has no joint with one degree of freedom"
                                 : "the joints of the coupling are both revolute and prismatic",
               "name another coupling with --of; " + name_remedy("", names, "couplings"),
               "map.mixed-joints");
}

std::string content_hash(const MapJob& job, const SimulatePlan& base) {
  std::string all;
  for (const RecordedFile& file : header_of(job.run, base, {}).files)
    all += std::to_string(file.bytes.size()) + ":" + file.bytes;
  return fmt::format("{:016x}", hash_of(all));
}

void check_plan(const MapJob& job, const SimulatePlan& plan, double x, double y) {
  const double steps = plan.run.duration / plan.run.step;
  if (plan.run.is_adaptive() || (steps >= 1 && steps <= kMaxSteps)) return;
  throw InputError(
      fmt::format("--x {} = {}, --y {} = {}", job.x.path, number_text(x), job.y.path,
                  number_text(y)),
      fmt::format("a run of {} s in steps of {} s {}", short_number_text(plan.run.duration),
                  short_number_text(plan.run.step),
                  steps < 1 ? "has no whole step" : "has more than 1e8 steps"),
      "choose other steps, or --duration", "map.steps");
}

// Diagnostics of the scene itself hide those of the axes.
void check_scene(MapJob& job, const std::string& of, DiagnosticList& faults) {
  const SimulatePlan base = prepare_simulation(job.run);
  check_couplings(*base.input.scene, of, job, faults);
  job.identity.push_back("content " + content_hash(job, base));
  for (const double y : {job.y.from, job.y.to})
    for (const double x : {job.x.from, job.x.to})
      attempt(faults, [&] { check_plan(job, prepare_cell(job, x, y), x, y); });
}

std::string or_scene(const std::optional<double>& value) {
  return value ? number_text(*value) : identity::kAsScene;
}

void check_axes(const MapJob& job, const MapOptions& options, DiagnosticList& faults) {
  if (job.x.path == job.y.path)
    faults.add("--y", "is the same parameter as --x", "give two parameters of the scene",
               "map.same-axes");
  for (const auto& [name, axis] : {std::pair{"--x", &job.x}, std::pair{"--y", &job.y}}) {
    for (const auto& [path, given] :
         {std::pair{"step", &options.step}, std::pair{"duration", &options.duration}})
      if (axis->path == path && *given)
        faults.add(std::string("--") + path, std::string(name) + " varies it",
                   "leave one of them out", "map.option-and-axis");
  }
  if (static_cast<double>(job.nx()) * job.ny() > kMaxMapCells)
    faults.add("--x, --y", fmt::format("{} x {} cells are too many", job.nx(), job.ny()),
               "give at most four million", "map.too-many-cells");
}

// Throws the diagnostics without repetitions (from several corners of the map).
void check_once(const DiagnosticList& faults) {
  try {
    faults.check();
  } catch (const InputError& error) {
    std::vector<Diagnostic> once;
    for (const Diagnostic& fault : error.faults())
      if (std::ranges::none_of(
              once, [&](const Diagnostic& other) { return to_string(other) == to_string(fault); }))
        once.push_back(fault);
    throw InputError(std::move(once));
  }
}

constexpr double kMaxCells = 4096;  // along an axis
const char* const kAxisForm =
    "write PATH:MIN:MAX:N[:log], as in coupling[0].stiffness:100:1e5:64:log";

// PATH:MIN:MAX:N[:log], or nothing and diagnostics of the option.
std::optional<MapAxis> parse_axis(const std::string& option, const std::string& text,
                                  DiagnosticList& faults) {
  bool good = true;
  const auto fault = [&](const std::string& problem, const std::string& fix,
                         std::string_view code) {
    faults.add(option, problem, fix, code);
    good = false;
  };
  const std::vector<std::string> parts = split(text, ':');
  if (parts.size() < 4 || parts.size() > 5 || parts[0].empty()) {
    fault("'" + text + "' is not an axis", kAxisForm, "axis.form");
    return std::nullopt;
  }
  MapAxis axis;
  axis.path = parts[0];
  const auto number = [&](std::size_t i, const char* name) {
    const auto value = parse_number(parts[i]);
    if (!value)
      fault(std::string(name) + " '" + parts[i] + "' is not a finite number", kAxisForm,
            "axis.number");
    return value.value_or(0);
  };
  axis.from = number(1, "MIN");
  axis.to = number(2, "MAX");
  const double count = number(3, "N");
  if (good && !(axis.from < axis.to))
    fault("MIN " + parts[1] + " is not below MAX " + parts[2], "give the smaller value first",
          "axis.order");
  if (good && (count < 2 || count > kMaxCells || count != std::floor(count)))
    fault("has " + parts[3] + " cells", "give a whole number of them, from 2 to 4096",
          "axis.count");
  axis.log = parts.size() == 5;
  if (axis.log && parts[4] != "log")
    fault("'" + parts[4] + "' is not known", "write log, or leave it out for a linear axis",
          "axis.scale");
  if (good && axis.log && !(axis.from > 0))
    fault("a logarithmic axis starts at " + parts[1], "start above 0, or leave ':log' out",
          "axis.log-from-zero");
  axis.count = static_cast<int>(good ? count : 0);
  if (!good) return std::nullopt;
  return axis;
}

}  // namespace

void set_parameters(const MapJob& job, double x, double y, Value& scene, DiagnosticList& faults) {
  set_number(scene, job.x.path, x, kLineOfX, "--x", faults);
  set_number(scene, job.y.path, y, kLineOfY, "--y", faults);
}

SimulatePlan prepare_cell(const MapJob& job, double x, double y) {
  SimulateOptions options = job.run;
  options.change_scene = [&](Value& scene, DiagnosticList&) {
    DiagnosticList faults;
    set_parameters(job, x, y, scene, faults);
    faults.check();
  };
  try {
    return prepare_simulation(options);
  } catch (const InputError& error) {
    throw attributed_to_axes(error, job, x, y);
  }
}

MapJob read_map_job(const MapOptions& options) {
  DiagnosticList faults;
  MapJob job;
  if (options.scene.empty())
    faults.add("command line", "no scene is given", "twinarm map SCENE.toml --x .. --y ..",
               "map.no-scene");
  else if (options.scene.extension() != ".toml")
    faults.add({options.scene.string(), 0, "", "is not a scene",
                "give a scene (TOML) that contains the robot", "map.no-scene"});
  const auto axis = [&](const char* name, const std::string& text, MapAxis& into) {
    if (text.empty())
      return faults.add(name, "is missing", "give PATH:MIN:MAX:N[:log]", "axis.missing");
    if (const auto found = parse_axis(name, text, faults)) into = *found;
  };
  axis("--x", options.x, job.x);
  axis("--y", options.y, job.y);
  const std::vector<std::string> measures(kMapMeasures.begin(), kMapMeasures.end());
  job.measure = static_cast<MapMeasure>(
      choose("--measure", options.measure, measures, "measures", faults, "map.measure")
          .value_or(0));
  job.run.robot.model = options.scene;
  job.run.duration = options.duration;
  job.run.step = options.step;
  job.run.integrator = options.integrator;
  faults.check();
  check_axes(job, options, faults);
  job.scene = read_toml(options.scene);
  job.x_unit = unit_of_number(job.scene, job.x.path);
  job.y_unit = unit_of_number(job.scene, job.y.path);
  job.identity = {
      "x " + job.x.text(),
      "y " + job.y.text(),
      "of " + (options.of.empty() ? identity::kFirstCoupling : options.of),
      "duration " + or_scene(options.duration),
      "step " + or_scene(options.step),
      "integrator " + (options.integrator.empty() ? identity::kAsScene : options.integrator)};
  check_scene(job, options.of, faults);
  check_once(faults);
  job.side_by_side = !options.no_simd && cell_batch(job);
  job.identity.push_back(std::string("cells ") +
                         (job.side_by_side ? identity::kSideBySide : identity::kOneByOne));
  return job;
}

double MapAxis::at(double u) const {
  if (u <= 0) return from;
  if (u >= count - 1) return to;
  const double part = u / (count - 1);
  return log ? from * std::pow(to / from, part) : from + (to - from) * part;
}

double MapAxis::place_of(double value) const {
  const double part =
      log ? std::log(value / from) / std::log(to / from) : (value - from) / (to - from);
  return part * (count - 1);
}

std::string MapAxis::text() const {
  return path + ":" + number_text(from) + ":" + number_text(to) + ":" + std::to_string(count) +
         (log ? ":log" : "");
}

}  // namespace twinarm
