#include "app/lab/run/lab_scene.h"

#include "app/record/record_run.h"
#include "app/support/text.h"

namespace twinarm {
namespace {

constexpr double kRealTimeBudget = 1e9;  // about a third of a processor [1/s]

// A change of what is an option of `simulate`, not a key of the scene's items.
bool apply_option(const Change& change, RunSettings& options, DiagnosticList& faults) {
  const auto number = [&](std::optional<double>& value) {
    value = parse_number(change.value);
    if (!value)
      faults.add("--set " + change.path + "=" + change.value, "not a number", "give a number",
                 "change.number");
  };
  if (change.path == "step")
    number(options.step);
  else if (change.path == "tolerance")
    number(options.tolerance);
  else if (change.path == "integrator")
    options.integrator = change.value;
  else if (change.path == "contact")
    options.contact = change.value;
  else if (change.path == "gravity")
    options.robot.gravity = change.value;
  else
    return false;
  return true;
}

// The changes of the scene itself; the others are written to `options`.
std::vector<Change> scene_changes(const std::vector<Change>& changes, RunSettings& options,
                                  DiagnosticList& faults) {
  std::vector<Change> others;
  for (const Change& change : changes)
    if (!apply_option(change, options, faults)) others.push_back(change);
  return others;
}

SimulateOptions without_outputs(SimulateOptions options) {
  if (!options.duration) options.duration = 1;
  options.every.reset();
  options.at.clear();
  options.record.clear();
  options.record_every.reset();
  options.json = options.csv = false;
  return options;
}

// Names the change in faults of the option that it set.
InputError name_changes(const InputError& error, const std::vector<Change>& changes) {
  return error.changed([&](Diagnostic& fault) {
    for (const Change& change : changes)
      if (is_of_option(fault, change.path))
        fault.where = "--set " + change.path + "=" + change.value;
  });
}

void put_file(RecordingHeader& header, const std::filesystem::path& path, std::string bytes) {
  std::erase_if(header.files, [&](const RecordedFile& file) { return file.path == path; });
  header.files.push_back({path.string(), std::move(bytes)});
}

void put_last(Value& scene, const std::string& key, Value value) {
  std::erase_if(scene.members, [&](const Value& member) { return member.key == key; });
  scene.put(key, std::move(value));
}

}  // namespace

LabScene::LabScene(const SimulateOptions& given, FileRoots roots) : roots_(std::move(roots)) {
  SimulateOptions options = without_outputs(given);
  options.budget = kRealTimeBudget;
  files_ = std::make_shared<const UnpackedRun>(header_of(options, prepare_simulation(options), {}));
  if (!roots_) return;
  roots_->push_back(files_->folder());
  for (const RecordedFile& file : files_->header().files) roots_->push_back(file.path);
}

LabScene::LabScene(RecordingHeader header, FileRoots roots) : roots_(std::move(roots)) {
  if (!header.run.duration) header.run.duration = 1;
  files_ = std::make_shared<const UnpackedRun>(std::move(header));
  if (roots_) roots_->push_back(files_->folder());
}

std::unique_ptr<LabScene::Plan> LabScene::plan(const std::vector<Change>& changes) const {
  RunSettings changed = files_->header().run;
  DiagnosticList faults;
  const std::vector<Change> others = scene_changes(changes, changed, faults);
  faults.check();
  try {
    SimulateOptions options = files_->options(others);
    scene_changes(changes, options, faults);
    options.has_operator = true;
    options.robot.roots = roots_;
    SimulatePlan prepared = prepare_simulation(options);
    if (prepared.run.is_adaptive() && !options.step)  // the tolerance alone sets none
      prepared.run.step = prepared.input.scene ? prepared.input.scene->description.step : 0.001;
    const std::filesystem::path own = options.robot.model.parent_path();
    for (std::string& warning : prepared.input.robot.warnings)
      warning = replace_all(std::move(warning), own.string() + "/", "");
    prepared.run.duration = HUGE_VAL;
    prepared.run.times.clear();
    return std::make_unique<Plan>(Plan{std::move(prepared), files_});
  } catch (const InputError& error) {
    throw name_changes(files_->with_original_paths(error, others), changes);
  }
}

Value LabScene::tree(const std::vector<Change>& changes) const {
  RunSettings changed = files_->header().run;
  DiagnosticList faults;
  const std::vector<Change> others = scene_changes(changes, changed, faults);
  Value scene = read_toml(files_->options().robot.model);
  for (const Change& change : others) apply(change, 0, scene, faults);
  if (!changed.robot.gravity.empty())
    if (const auto g = parse_gravity(changed.robot.gravity, faults))
      put_last(scene, "gravity", Value::numbers(*g));
  faults.check();
  if (changed.step) put_last(scene, "step", Value::of(*changed.step));
  if (!changed.integrator.empty()) put_last(scene, "integrator", Value::of(changed.integrator));
  if (!changed.contact.empty()) put_last(scene, "contact", Value::of(changed.contact));
  return scene;
}

std::shared_ptr<const LabScene> LabScene::edited(const std::vector<Change>& changes,
                                                 const SceneEdit& edit) const {
  if (!is_scene())
    throw InputError({{"command", 0, "edit", "a recording of a robot alone cannot be edited",
                       "open the robot's file", "lab.edit"}});
  Value scene = tree(changes);
  apply(edit, *plan(changes)->prepared.input.scene, scene);
  RecordingHeader changed = header(changes, {});
  put_file(changed, changed.run.robot.model, to_toml(scene));
  return std::make_shared<const LabScene>(std::move(changed), roots_);
}

std::string LabScene::text(const std::vector<Change>& changes) const {
  return is_scene() ? to_toml(tree(changes)) : "";
}

RecordingHeader LabScene::header(const std::vector<Change>& changes, const Hand& hand) const {
  const std::unique_ptr<Plan> planned = plan(changes);
  RecordingHeader header = files_->header();
  DiagnosticList faults;
  scene_changes(changes, header.run, faults);
  describe_frames(planned->prepared, header);
  header.run.step = header.step;
  if (!is_scene()) return header;
  const std::filesystem::path log = header.run.robot.model.parent_path() / "lab_operator.csv";
  Value scene = tree(changes);
  for (Value& list : scene.members)
    for (const std::size_t index : hand.couplings)
      if (list.key == "coupling" && index < list.items.size() && !hand.log.empty())
        put_last(list.items[index], "target", Value::of(log.string()));
  put_file(header, header.run.robot.model, to_toml(scene));
  if (!hand.log.empty()) put_file(header, log, hand.log);
  return header;
}

}  // namespace twinarm
