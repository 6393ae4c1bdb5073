#include "app/lab/run/lab_scene.h"

#include <cmath>
#include <utility>

#include "app/data/value.h"
#include "app/record/record_run.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

// What a change turns that stands beside the scene, as on the command line of `simulate`.
bool turns_option(const Change& change, SimulateOptions& options, DiagnosticList& faults) {
  const auto number = [&](std::optional<double>& value) {
    value = parse_number(change.value);
    if (!value)
      faults.add({"", 0, "--set " + change.path + "=" + change.value, "it is no number", "",
                  "change.number"});
  };
  if (change.path == "step")
    number(options.step);
  else if (change.path == "tolerance")
    number(options.tolerance);
  else if (change.path == "integrator")
    options.integrator = change.value;
  else if (change.path == "contact")
    options.contact = change.value;
  else
    return false;
  return true;
}

std::vector<Change> of_the_scene(const std::vector<Change>& changes, SimulateOptions& options,
                                 DiagnosticList& faults) {
  std::vector<Change> others;
  for (const Change& change : changes)
    if (!turns_option(change, options, faults)) others.push_back(change);
  return others;
}

SimulateOptions without_end(SimulateOptions options) {
  if (!options.duration) options.duration = 1;
  options.every.reset();
  options.at.clear();
  options.record.clear();
  options.record_every.reset();
  options.json = options.csv = false;
  return options;
}

// Faults of options by the change that set them.
InputError by_change(const InputError& error, const std::vector<Change>& changes) {
  std::vector<Diagnostic> faults = error.faults();
  for (Diagnostic& fault : faults)
    for (const Change& change : changes)
      if (is_of_option(fault, change.path))
        fault.where = "--set " + change.path + "=" + change.value;
  return InputError(std::move(faults));
}

// As the last of them.
void put_last(Value& scene, const std::string& key, Value value) {
  std::erase_if(scene.members, [&](const Value& member) { return member.key == key; });
  scene.put(key, std::move(value));
}

}  // namespace

LabScene::LabScene(const SimulateOptions& given, FileRoots roots) : roots_(std::move(roots)) {
  const SimulateOptions options = without_end(given);
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

bool LabScene::is_scene() const {
  return files_->header().run.model.extension() == ".toml";
}

std::unique_ptr<LabScene::Plan> LabScene::plan(const std::vector<Change>& changes) const {
  SimulateOptions beside = options_of(files_->header().run);
  DiagnosticList faults;
  const std::vector<Change> others = of_the_scene(changes, beside, faults);
  faults.check();
  try {
    SimulateOptions options = files_->options(others);
    options.step = beside.step;
    options.tolerance = beside.tolerance;
    options.integrator = beside.integrator;
    options.contact = beside.contact;
    options.has_hand = true;
    options.robot.roots = roots_;
    SimulatePlan prepared = prepare_simulation(options);
    if (prepared.run.is_adaptive() && !options.step)  // not all of the run in one
      prepared.run.step = prepared.input.scene ? prepared.input.scene->description.step : 0.001;
    prepared.run.duration = HUGE_VAL;
    prepared.run.times.clear();
    return std::make_unique<Plan>(Plan{std::move(prepared), files_});
  } catch (const InputError& error) {
    throw by_change(files_->as_typed(error, others), changes);
  }
}

Value LabScene::tree(const std::vector<Change>& changes) const {
  SimulateOptions beside = options_of(files_->header().run);
  DiagnosticList faults;
  const std::vector<Change> others = of_the_scene(changes, beside, faults);
  Value scene = read_toml(files_->options().robot.model);
  for (std::size_t i = 0; i < others.size(); ++i)
    if (others[i].path != "gravity") apply(others[i], 0, scene, faults);
  for (const Change& change : others)
    if (change.path == "gravity") beside.robot.gravity = change.value;
  if (!beside.robot.gravity.empty())
    if (const auto g = parse_gravity(beside.robot.gravity, faults)) {
      Value gravity = Value::list({});
      for (const double component : *g) gravity.items.push_back(Value::of(component));
      put_last(scene, "gravity", std::move(gravity));
    }
  faults.check();
  if (beside.step) put_last(scene, "step", Value::of(*beside.step));
  if (!beside.integrator.empty()) put_last(scene, "integrator", Value::of(beside.integrator));
  if (!beside.contact.empty()) put_last(scene, "contact", Value::of(beside.contact));
  return scene;
}

std::string LabScene::text(const std::vector<Change>& changes) const {
  return is_scene() ? to_toml(tree(changes)) : "";
}

RecordingHeader LabScene::header(const std::vector<Change>& changes, const Hand& hand) const {
  const std::unique_ptr<Plan> planned = plan(changes);
  RecordingHeader header = files_->header();
  DiagnosticList faults;
  SimulateOptions options = options_of(header.run);
  for (const Change& change : of_the_scene(changes, options, faults))
    if (change.path == "gravity") options.robot.gravity = change.value;
  header.run = recorded_run(options);
  describe_frames(planned->prepared, header);
  header.run.step = header.step;
  if (!is_scene()) return header;
  const std::filesystem::path log = header.run.model.parent_path() / "lab_hand.csv";
  Value scene = tree(changes);
  for (Value& list : scene.members)
    for (const std::size_t place : hand.couplings)
      if (list.key == "coupling" && place < list.items.size() && !hand.log.empty())
        put_last(list.items[place], "target", Value::of(log.string()));
  for (RecordedFile& file : header.files)
    if (file.path == header.run.model) file.bytes = to_toml(scene);
  if (!hand.log.empty()) header.files.push_back({log.string(), hand.log});
  return header;
}

}  // namespace twinarm
