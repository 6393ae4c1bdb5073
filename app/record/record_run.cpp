#include "app/record/record_run.h"

#include <unordered_map>

#include "app/render/list/image.h"
#include "app/support/progress.h"
#include "app/support/text.h"
#include "app/support/version.h"
#include "collision/mesh_files/model_file.h"
#include "solver/support/input_file.h"

namespace twinarm {
namespace {

void add_file(std::vector<RecordedFile>& files, const std::filesystem::path& file) {
  std::error_code ignored;
  if (file.empty() || !std::filesystem::is_regular_file(file, ignored)) return;
  const std::string path = std::filesystem::absolute(file).lexically_normal().string();
  const auto is_same = [&](const RecordedFile& f) { return f.path == path; };
  if (std::ranges::none_of(files, is_same)) files.push_back({path, read_whole_file(file)});
}

// Files in the assets are trusted.
bool is_asset(const std::filesystem::path& file) {
  DiagnosticList no_assets;
  return attempt(no_assets, [&] { return may_name(std::vector{find_assets()}, file); })
      .value_or(false);
}

template <class Decode>
bool is_decodable(const Decode& decode, const std::filesystem::path& file) {
  DiagnosticList ignored;
  return attempt(ignored, [&] { decode(file); }).has_value();
}

// A scene may name any file of this machine as a picture or mesh: the contents are recorded only if
// they can be decoded.
template <class Decode>
void add_decoded(std::vector<RecordedFile>& files, const std::filesystem::path& file,
                 const Decode& decode) {
  const std::size_t before = files.size();
  add_file(files, file);
  if (files.size() > before && !is_asset(file) && !is_decodable(decode, file))
    files.back().bytes.clear();
}

// Files that a mesh file refers to: materials with their textures, glTF buffers.
void add_companions(std::vector<RecordedFile>& files, const std::filesystem::path& file) {
  constexpr int kMaxFiles = 1000;  // searched in the folder
  static const std::vector<std::string> naming{".obj", ".mtl", ".dae", ".gltf"};
  if (std::ranges::find(naming, file.extension().string()) == naming.end()) return;
  const std::string text = files.back().bytes;
  std::error_code error;
  int looked_at = 0;
  for (const auto& other :
       std::filesystem::recursive_directory_iterator(file.parent_path(), error)) {
    if (++looked_at > kMaxFiles) return;
    const std::size_t before = files.size();
    const std::filesystem::path end = other.path().extension();
    if (text.find(other.path().filename().string()) != std::string::npos &&
        (end == ".mtl" || end == ".bin" || is_decodable(read_image, other.path())))
      add_file(files, other.path());
    if (files.size() > before) add_companions(files, other.path());
  }
}

void add_mesh(std::vector<RecordedFile>& files, const ShapeDescription& geometry) {
  const auto* mesh = std::get_if<MeshGeometry>(&geometry);
  if (!mesh) return;
  const std::size_t before = files.size();
  add_decoded(files, mesh->file, [](const std::filesystem::path& file) { read_model(file); });
  if (files.size() > before) add_companions(files, mesh->file);
}

void add_meshes_of(const RobotDescription& robot, std::vector<RecordedFile>& files) {
  for (const LinkDescription& link : robot.links) {
    for (const VisualPart& part : link.visuals) {
      add_mesh(files, part.geometry);
      add_decoded(files, part.texture, read_image);
    }
    for (const CollisionPart& part : link.collisions) add_mesh(files, part.geometry);
  }
}

// Files of the scene: robots, meshes, textures, traces.
void add_files_of(const SceneDescription& scene, std::vector<RecordedFile>& files) {
  for (const RobotInScene& robot : scene.robots) {
    add_file(files, robot.description.file);
    add_meshes_of(robot.description, files);
  }
  for (const BodyDescription& body : scene.bodies) {
    add_mesh(files, body.shape);
    add_decoded(files, body.texture, read_image);
  }
  for (const CouplingDescription& coupling : scene.couplings)
    add_file(files, coupling.target.trace);
}

void add_contacts_of(const SceneContacts* all, RecordedFrame& frame) {
  if (!all || !all->contacts()) return;
  frame.contacts.reserve(all->contacts()->points().size());
  for (const ContactPoint& p : all->contacts()->points()) {
    if (p.force_W.isZero(0) && p.couple_W.isZero(0)) continue;
    frame.contacts.push_back({p.contact.a, p.contact.b, p.contact.depth, p.contact.p_WC,
                              p.contact.n_W, p.force_W, p.couple_W});
  }
}

using recording_format::kMomentumName, recording_format::kName;

// Rows of the balances, by the indices of their names.
template <class NumberOf>
void add_rows(const SteppedRun& run, RecordedFrame& frame, const NumberOf& number_of) {
  for (const EnergyRow& row : run.energy_balance()) {
    frame.rows.push_back(number_of(kName, row.name));
    frame.works.push_back(row.work);
  }
  for (const MomentumRow& row : run.momentum()) {
    frame.momentum_rows.push_back(number_of(kMomentumName, row.name));
    frame.momenta.insert(frame.momenta.end(), {row.linear, row.angular});
  }
}

// Bitwise. Of frames without memory: all but the balances, whose rows may have other numbers.
bool is_same(RecordedFrame a, RecordedFrame b) {
  if (!a.memory.empty()) return a.memory == b.memory;
  StateArchive one, other;
  visit_motion(one, a);
  visit_motion(other, b);
  return one.bytes() == other.bytes();
}

Replay run_on(const Recording& recording, std::size_t first, const SimulatePlan& prepared,
              std::string memory) {
  const RecordedFrame begin = recording.frame(first);
  Replay found;
  found.step = begin.step;
  found.from = found.to = begin.t;
  found.first = first;
  found.hash = hash_of(begin, recording.version());
  if (prepared.input.scene)
    for (int b = prepared.input.scene->robot_bodies + 1;
         b < prepared.input.robot.model.body_count(); ++b)
      found.bodies.push_back(prepared.input.robot.model.body_name[static_cast<std::size_t>(b)]);
  std::size_t next = first;
  RunWatch watch;
  watch.look = [&](SteppedRun& run) {
    if (next >= recording.size()) return;
    const RecordedFrame recorded = recording.frame(next);
    if (run.step() != recorded.step) return;
    RecordedFrame frame = frame_of(run, prepared, !recorded.memory.empty());
    take_state_from_memory(frame);
    found.to = frame.t;
    if (next == first) {
      frame.hash = hash_of(frame.memory);
      found.hash_again = hash_of(frame, recording.version());
    } else {
      ++found.compared;
      const bool same = is_same(recorded, frame);
      found.equal += same ? 1 : 0;
      if (!same && found.first_different < 0) found.first_different = frame.t;
    }
    frame.memory.clear();
    add_energy_balances(run, found.rows, found.momentum_rows, frame);
    found.frames.push_back(std::move(frame));
    ++next;
  };
  watch.tick = [](double) { check_interrupt(); };
  const RunStart start{std::move(memory), recording.frame(recording.size() - 1).step};
  run_plan(prepared.input, prepared.run, watch, &start);
  return found;
}

}  // namespace

void describe_frames(const SimulatePlan& prepared, RecordingHeader& header) {
  header.integrator = integrator_name(prepared.run.integrator);
  header.step = prepared.run.step;
  header.columns = run_columns(prepared.input.robot);
  header.couplings.clear();
  header.geometries.clear();
  if (!prepared.input.scene) return;
  const SceneModel& scene = *prepared.input.scene;
  for (const SceneCoupling& coupling : scene.couplings) header.couplings.push_back(coupling.name);
  for (const SceneGeometry& geometry : scene.geometries) header.geometries.push_back(geometry.name);
}

RecordingHeader header_of(const SimulateOptions& options, const SimulatePlan& prepared,
                          std::vector<std::string> command) {
  RecordingHeader header;
  header.program = kProgramVersion;
  header.command = std::move(command);
  header.run = options;
  header.run.robot.roots = {};
  header.run.robot.changes = {};  // the recorded scene contains them
  for (std::filesystem::path* path : {&header.run.robot.model, &header.run.robot.state})
    if (!path->empty()) *path = std::filesystem::absolute(*path).lexically_normal();
  if (options.scene || !options.robot.changes.empty()) {
    DiagnosticList faults;  // the plan has reported them
    header.files.push_back({header.run.robot.model.string(), to_toml(scene_tree(options, faults))});
  } else {
    add_file(header.files, options.robot.model);
  }
  add_file(header.files, options.robot.state);
  header.duration = prepared.run.duration;
  describe_frames(prepared, header);
  add_meshes_of(prepared.input.robot.robot, header.files);
  if (prepared.input.scene) add_files_of(prepared.input.scene->description, header.files);
  return header;
}

RecordedFrame frame_of(SteppedRun& run, const SimulatePlan& prepared, bool with_memory) {
  RecordedFrame frame;
  State<double> x = run.simulation().state();
  frame.step = run.step();
  frame.t = x.t;
  frame.values = run_values(prepared.input.robot, x, run.simulation().kinematics());
  if (const SceneCouplings* couplings = prepared.input.couplings.get())
    for (std::size_t c = 0; c < couplings->size(); ++c)
      frame.coupling_forces.push_back(couplings->force(c));
  add_contacts_of(run.contacts(), frame);
  if (with_memory) {
    frame.memory = run.memory();
    return frame;
  }
  StateArchive state;
  visit_state(state, prepared.input.robot.model, x);
  StateArchive(state.bytes()).visit(frame.q, frame.qd);
  return frame;
}

void add_energy_balances(const SteppedRun& run, std::vector<std::string>& names,
                         std::vector<std::string>& momentum_names, RecordedFrame& frame) {
  const std::array lists{&names, &momentum_names};
  std::array<std::unordered_map<std::string, std::size_t>, 2> numbers;  // a heap has thousands
  for (const std::size_t k : {0, 1})
    for (const std::string& name : *lists[k]) numbers[k].emplace(name, numbers[k].size());
  add_rows(run, frame, [&](char kind, const std::string& name) {
    const std::size_t k = kind == kName ? 0 : 1;
    const auto [found, is_new] = numbers[k].try_emplace(name, numbers[k].size());
    if (is_new) lists[k]->push_back(name);
    return static_cast<std::uint32_t>(found->second);
  });
}

RunRecorder::RunRecorder(const std::filesystem::path& file, RecordingHeader header,
                         const SimulatePlan& prepared, double every, long keyframe_every)
    : writer_(file, std::move(header), keyframe_every), prepared_(prepared), every_(every) {}

void RunRecorder::look(SteppedRun& run) {
  const double t = run.simulation().state().t, slack = 1e-6 * std::min(prepared_.run.step, 1e-3);
  const bool at_end = t >= prepared_.run.duration - slack;
  if (every_ > 0 && t < next_ - slack && !at_end) return;
  while (every_ > 0 && next_ <= t + slack) next_ += every_;
  write(run);
}

void RunRecorder::write(SteppedRun& run) {
  RecordedFrame frame = frame_of(run, prepared_, writer_.needs_memory(run.step()));
  add_rows(run, frame,
           [&](char kind, const std::string& name) { return writer_.number_of(kind, name); });
  writer_.write(frame);
}

SimulateResult record_plan(const SimulateOptions& options, const SimulatePlan& prepared,
                           RunWatch watch) {
  const std::vector<std::string> command{"twinarm", "simulate", options.robot.model.string(),
                                         "--record", options.record.string()};
  RunRecorder recorder(options.record, header_of(options, prepared, command), prepared);
  watch.interrupted = is_interrupted;
  watch.look = [&, look = std::move(watch.look)](SteppedRun& run) {
    look(run);
    recorder.look(run);
  };
  try {
    SimulateResult result = run_plan(prepared.input, prepared.run, watch);
    recorder.finish(result.post_mortem ? "stopped: " + result.post_mortem->reason : "done");
    return result;
  } catch (const Interrupted&) {
    recorder.finish("interrupted");
    throw;
  }
}

Replay replay(const Recording& recording, std::size_t first, const std::vector<Change>& changes) {
  const UnpackedRun files(recording.header());
  SimulateOptions options = files.options(changes);
  options.energy_bound = HUGE_VAL;  // runs to the last recorded frame
  try {
    SimulatePlan prepared = prepare_simulation(options);
    prepared.run.times.clear();
    return run_on(recording, first, prepared, memory_at(recording, first, files));
  } catch (const InputError& error) {
    throw files.with_original_paths(error, changes);
  }
}

}  // namespace twinarm
