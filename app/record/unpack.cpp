#include "app/record/unpack.h"

#include "app/run/stepped_run.h"
#include "app/support/progress.h"
#include "app/support/text.h"
#include "app/support/version.h"

namespace twinarm {

namespace {

// Negative line numbers mark values from a change.
int line_of_change(std::size_t change) {
  return -1 - static_cast<int>(change);
}

// Keys and types of earlier versions become today's.
void update_names(Value& value) {
  if (const std::string now = renamed("keys", value.key); !now.empty()) value.key = now;
  if (const std::string now = renamed("values", value.text); value.key == "type" && !now.empty())
    value.text = now;
  for (Value& item : value.items) update_names(item);
  for (Value& member : value.members) update_names(member);
}

}  // namespace

UnpackedRun::UnpackedRun(RecordingHeader header) : header_(std::move(header)) {
  write_missing();
}

// Cleaners of temporary folders may remove copies while they are in use.
void UnpackedRun::write_missing() const {
  const std::lock_guard lock(writing_);
  copies_.make_again();
  for (const RecordedFile& file : header_.files) {
    const std::filesystem::path copy = copy_of(file.path);
    std::error_code ignored;
    if (std::filesystem::is_regular_file(copy, ignored)) continue;
    std::filesystem::create_directories(copy.parent_path(), ignored);
    write_whole_file(copy, file.bytes);
  }
}

// The original path below the folder, so that relative references work. Normalisation removes "..".
std::filesystem::path UnpackedRun::copy_of(const std::filesystem::path& original) const {
  if (!original.is_absolute())
    throw InputError(
        {{original.string(), 0, "a file in the recording", "its path is not absolute",
          "the recording is damaged, or not made by twinarm: record it again", "recording.path"}});
  return folder() / original.lexically_normal().relative_path();
}

// Replaces texts that name one of the files (absolute, or below assets/) by the path of its copy.
void UnpackedRun::redirect_paths(Value& value) const {
  if (value.kind == Value::Kind::text && !value.text.empty()) {
    const std::string name = std::filesystem::path(value.text).lexically_normal().string();
    for (const RecordedFile& file : header_.files)
      if (file.path == name || file.path.ends_with("/" + name))
        value.text = copy_of(file.path).string();
  }
  for (Value& item : value.items) redirect_paths(item);
  for (Value& member : value.members) redirect_paths(member);
}

SimulateOptions UnpackedRun::options(const std::vector<Change>& changes) const {
  write_missing();
  SimulateOptions options;
  static_cast<RunSettings&>(options) = header_.run;
  options.robot.model = copy_of(options.robot.model);
  if (!options.robot.state.empty()) options.robot.state = copy_of(options.robot.state);
  const bool is_scene = options.robot.model.extension() == ".toml";
  std::vector<std::pair<Change, int>> of_scene;  // and their lines
  static const std::vector<std::string> kept{"step", "integrator", "duration", "contact"};
  DiagnosticList faults;
  for (std::size_t i = 0; i < changes.size(); ++i)
    if (changes[i].path == "gravity")
      options.robot.gravity = changes[i].value;
    else if (std::ranges::find(kept, changes[i].path) != kept.end())
      faults.add("--set " + changes[i].path,
                 "a branch keeps step, integrator, duration and contact model of its recording",
                 "run `twinarm simulate` with another " + changes[i].path, "change.method");
    else if (is_scene)
      of_scene.emplace_back(changes[i], line_of_change(i));
    else
      faults.add("--set " + changes[i].path, "only gravity can be changed for a URDF",
                 "write --set gravity=x,y,z, or record a scene", "change.robot");
  faults.check();
  options.change_scene = [this, of_scene](Value& tree, DiagnosticList& found) {
    update_names(tree);
    redirect_paths(tree);
    for (std::size_t i = 0; i < of_scene.size(); ++i)
      apply(of_scene[i].first, of_scene[i].second, tree, found);
  };
  return options;
}

SimulatePlan UnpackedRun::prepare(const SimulateOptions& options) const try {
  return prepare_simulation(options);
} catch (const InputError& error) {
  throw with_original_paths(error);
}

InputError UnpackedRun::with_original_paths(const InputError& error,
                                            const std::vector<Change>& changes) const {
  const std::string folder = this->folder().string();
  return error.changed([&](Diagnostic& fault) {
    for (std::string* text : {&fault.file, &fault.where, &fault.problem, &fault.fix})
      *text = replace_all(std::move(*text), folder, "");
    for (std::size_t i = 0; i < changes.size(); ++i) {
      const std::string typed = "--set " + changes[i].path + "=" + changes[i].value;
      if (fault.line == line_of_change(i))
        fault = {"", 0, typed, fault.where + ": " + fault.problem, fault.fix, fault.code};
      else if (changes[i].path == "gravity" && is_of_option(fault, "gravity"))
        fault = {"", 0, typed, fault.problem, "write --set gravity=0,0,-9.81", fault.code};
    }
  });
}

bool is_recording(const std::filesystem::path& file) {
  if (file.extension() == ".twinrec") return true;  // the reader reports a missing file
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) {
    std::ifstream stream(file, std::ios::binary);
    std::string start(8, '\0');
    stream.read(start.data(), 8);
    if (stream && start == std::string(recording_format::kMagic, 8)) return true;
  }
  return !std::filesystem::exists(file, ignored) && std::filesystem::exists(part_of(file), ignored);
}

void check_recorded(const RobotOptions& given, DiagnosticList& faults) {
  if (given.state.empty() && given.gravity.empty() && given.changes.empty() && !given.floating &&
      given.friction && given.armature && !given.strict && !given.missing.any())
    return;
  faults.add(
      "--state, --gravity, --floating, --no-friction, --no-armature, --strict, --density, "
      "--min-mass, --set",
      "a recording has its own state and model", "leave them out; choose by --at",
      "option.conflict");
}

std::string memory_at(const Recording& recording, std::size_t n, const UnpackedRun& files) {
  RecordedFrame frame = recording.frame(n);
  if (!frame.memory.empty()) return frame.memory;
  SimulateOptions options = files.options();
  options.energy_bound = HUGE_VAL;
  SimulatePlan prepared = files.prepare(options);
  prepared.run.times.clear();
  std::string memory;
  RunWatch watch;
  watch.look = [&](SteppedRun& run) {
    if (run.step() == frame.step) memory = run.memory();
  };
  watch.tick = [](double) { check_interrupt(); };
  const RunStart start{recording.frame(recording.keyframe(n)).memory, frame.step};
  run_plan(prepared.input, prepared.run, watch, &start);
  if (memory.empty())
    throw InputError(fmt::format("step {} of the recording", frame.step),
                     "this program does not reach it from the keyframe before",
                     "read it with the twinarm that recorded it", "recording.numbers");
  RecordedFrame repeated;
  repeated.memory = memory;
  take_state_from_memory(repeated);
  if (repeated.q != frame.q || repeated.qd != frame.qd)
    print_error(
        "twinarm: step {} has other bits than recorded (by {}, this is {}): bit-exact replay needs "
        "the same version on the same kind of processor\n",
        frame.step, recording.header().program, kProgramVersion);
  return memory;
}

State<double> recorded_state(RecordedFrame frame, const Model<double>& model) {
  State<double> x(model);
  try {
    take_state_from_memory(frame);
    StateArchive state;
    state.visit(frame.q, frame.qd, frame.t);
    StateArchive memory(state.bytes());
    visit_state(memory, model, x);
  } catch (const std::runtime_error& error) {
    throw InputError("a frame of the recording", error.what(),
                     "the recording is damaged: record it again", "recording.numbers");
  }
  return x;
}

RecordedInstant open_instant(const std::filesystem::path& file, std::optional<double> at) {
  const Recording recording(file);
  for (const std::string& note : recording.notes()) print_error("twinarm: {}\n", note);
  const std::size_t n = at ? recording.at(*at, "--at") : recording.size() - 1;
  const RecordedFrame frame = recording.frame(n);
  const auto files = std::make_shared<const UnpackedRun>(recording.header());
  SimulateOptions options = files->options();
  options.integrator = "semi-implicit";
  options.step = recording.header().step;
  options.tolerance.reset();
  SimulatePlan prepared = files->prepare(options);
  prepared.run.integrator =
      find_integrator(recording.header().integrator).value_or(Integrator::semi_implicit);
  RecordedInstant instant{
      std::move(prepared), simulation_memory(memory_at(recording, n, *files)), frame.t, {}, files};
  for (std::size_t i = 0; i < frame.rows.size(); ++i)
    instant.energy_balance.push_back(
        {EnergyRowKind::earlier, recording.rows()[frame.rows[i]], frame.works[i]});
  set_pose(instant.prepared.input.robot, recorded_state(frame, instant.prepared.input.robot.model));
  return instant;
}

}  // namespace twinarm
