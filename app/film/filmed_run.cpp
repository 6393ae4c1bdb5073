#include "app/film/filmed_run.h"

#include "app/record/record_run.h"

namespace twinarm {
namespace {

constexpr int kAround = 240;          // instants of the whole run
constexpr double kMaxPictures = 1e5;  // of a film

// The initial state has no forces yet: those of the first step are shown.
void take_forces_of_first_step(FilmedRun& run, const RunInstant& first) {
  for (std::vector<RunInstant>* instants : {&run.shown, &run.around})
    for (RunInstant& instant : *instants)
      if (instant.x.t < first.x.t) {
        instant.coupling_forces = first.coupling_forces;
        instant.contacts = first.contacts;
      }
}

std::vector<double> picture_times(double from, double to, double interval) {
  if ((to - from) / interval > kMaxPictures)
    throw InputError("--slow-motion", "the film would have more than 100000 pictures",
                     "shorten it by --from and --to", "film.too-long");
  std::vector<double> times;
  const auto count = static_cast<long>(std::floor((to - from) / interval + 1e-6));
  for (long i = 0; i <= count; ++i) times.push_back(from + static_cast<double>(i) * interval);
  return times;
}

void check_piece(double from, double to) {
  if (!(from >= 0 && to > from))
    throw InputError("--from", fmt::format("the film goes from {:g} s to {:g} s", from, to),
                     "give 0 <= --from < --to", "option.order");
}

// Reports both options.
void check_within(const Recording& recording, double from, double to) {
  DiagnosticList faults;
  attempt(faults, [&] { return recording.at(from, "--from"); });
  attempt(faults, [&] { return recording.at(to, "--to"); });
  faults.check();
}

FilmedRun film_recording(const std::filesystem::path& file, const FilmTimes& times) {
  auto recording = std::make_unique<const Recording>(file);
  for (const std::string& note : recording->notes()) print_error("twinarm: {}\n", note);
  auto files = std::make_unique<const UnpackedRun>(recording->header());
  FilmedRun run{{}, nullptr, nullptr, files->prepare(files->options()), {}, {}};
  const Model<double>& model = run.model();
  const std::size_t size = recording->size();
  const auto frame_at = [&](std::size_t n) { return instant_of(recording->frame(n), model); };

  const double first = recording->frame(0).t, last = recording->frame(size - 1).t;
  const auto frame_of_time = [&](double t, const char* option) {
    return frame_at(recording->at(times.waits ? std::clamp(t, first, last) : t, option));
  };
  if (times.is_film) {
    const double from = times.from.value_or(first), to = times.to.value_or(last);
    check_piece(from, to);
    if (!times.waits) check_within(*recording, from, to);
    for (const double t : picture_times(from, to, times.interval)) {
      check_interrupt();
      run.shown.push_back(frame_of_time(std::min(t, to), "--to"));
    }
  } else {
    run.shown.push_back(times.at ? frame_of_time(*times.at, "--at") : frame_at(size - 1));
  }
  const std::size_t stride = std::max<std::size_t>(1, size / kAround);
  for (std::size_t n = 0; n < size; n += stride) run.around.push_back(frame_at(n));
  if (size > 1) take_forces_of_first_step(run, frame_at(1));
  run.recording = std::move(recording);
  run.files = std::move(files);
  return run;
}

// Replaces --duration of `twinarm simulate` in messages by the option of `render`.
SimulatePlan prepare_to_film(const SimulateOptions& options, const FilmTimes& times) {
  try {
    return prepare_simulation(options);
  } catch (const InputError& error) {
    const std::string option = times.is_film ? "--to" : "--at";
    throw error.changed([&](Diagnostic& fault) {
      if (!is_of_option(fault, "duration")) return;
      fault.where = option;
      if (!fault.fix.empty()) fault.fix = "give " + option + " SECONDS";
    });
  }
}

FilmedRun simulate_for_film(const RobotOptions& robot, const FilmTimes& times,
                            const std::string& camera, Progress& progress) {
  SimulateOptions options;
  options.robot = robot;
  // A picture of the start needs no masses.
  options.robot.kinematic = !times.is_film && times.at.value_or(0) <= 0;
  options.duration = times.is_film ? times.to : times.at && *times.at > 0 ? *times.at : 1.0;
  FilmedRun run{{}, nullptr, nullptr, prepare_to_film(options, times), {}, {}};
  parse_camera(camera, run.model());  // reports errors before the run
  RunPlan& plan = run.plan.run;
  plan.times.clear();
  const double start = times.from.value_or(0);
  const double end =
      times.is_film ? times.to.value_or(plan.duration) : std::max(times.at.value_or(0), 0.0);
  if (times.is_film) check_piece(start, end);
  print_warnings(run.plan.input.robot.warnings, false);
  const SceneModel* scene = run.plan.input.scene.get();
  if (const auto last = scene ? scene->description.duration : std::nullopt; last && times.at > last)
    throw InputError("--at",
                     fmt::format("{:g} s is beyond the scene's end at {:g} s", *times.at, *last),
                     "give an earlier time, or a longer 'duration' in the scene", "film.time");
  if (plan.is_adaptive() && times.is_film) plan.step = std::min(plan.step, times.interval);
  plan.duration = end > 0 ? end : plan.step;  // one step for the forces at the start
  const double around = std::max(end / kAround, 0.0), slack = 1e-6 * plan.step;
  std::vector<double> wanted{end};
  if (times.is_film) wanted = picture_times(start, end, times.interval);

  double next_around = 0;
  std::size_t next = 0;
  std::optional<RunInstant> first;
  RunWatch watch;
  watch.look = [&](SteppedRun& view) {
    const double t = view.simulation().state().t;
    const bool shows = next < wanted.size() && t >= wanted[next] - slack;
    const bool looks = t >= next_around - slack && (end > 0 || t <= 0);
    const bool is_first = view.step() == 1;
    if (!shows && !looks && !is_first) return;
    const RunInstant instant = instant_of(frame_of(view, run.plan), run.model());
    if (is_first) first = instant;
    for (; next < wanted.size() && t >= wanted[next] - slack; ++next) run.shown.push_back(instant);
    if (!looks) return;
    run.around.push_back(instant);
    while (around > 0 && next_around <= t + slack) next_around += around;
  };
  watch.tick = [&](double t) { progress.advance(t, plan.duration); };
  const SimulateResult result = run_plan(run.plan.input, plan, watch);
  if (result.post_mortem)
    print_error("twinarm: the run diverged after t = {:g} s: {}\n", result.end,
                result.post_mortem->reason);
  if (run.shown.empty())
    throw InputError("--at", "the run stopped before that time",
                     fmt::format("give one up to {:g} s", result.end), "film.time");
  if (first) take_forces_of_first_step(run, *first);
  return run;
}

// `moves`: bodies_with_dofs().
ShownContact shown(const SceneModel& scene, const std::vector<char>& moves, RecordedContact c) {
  const auto body = [&](int g) {
    return static_cast<std::size_t>(scene.geometries[static_cast<std::size_t>(g)].body);
  };
  const double friction = scene.surface_of_pair(c.a, c.b).friction;
  if (!moves[body(c.b)] && moves[body(c.a)]) {
    std::swap(c.a, c.b);
    for (Vector3* v : {&c.normal, &c.force, &c.couple}) *v = -*v;
  }
  return {c.a, c.b, body(c.a), body(c.b), c.point, c.normal, c.force, c.couple, friction};
}

}  // namespace

std::vector<FilmedRun> film_pair(const std::filesystem::path& left,
                                 const std::filesystem::path& right, FilmTimes times) {
  DiagnosticList faults;
  for (const auto* file : {&left, &right})
    if (!is_recording(*file))
      faults.add({file->string(), 0, "--side-by-side", "not a recording",
                  "give two files of `twinarm simulate --record FILE`", "file.no-recording"});
  faults.check();
  double earliest = 1e300, first = 0, last = 0;
  for (const auto* file : {&left, &right}) {
    const Recording recording(*file);
    earliest = std::min(earliest, recording.frame(0).t);
    first = std::max(first, recording.frame(0).t);
    last = std::max(last, recording.frame(recording.size() - 1).t);
  }
  for (const auto& [t, option] :
       {std::pair{times.at, "--at"}, {times.from, "--from"}, {times.to, "--to"}})
    if (t && !(*t >= earliest - 1e-9 && *t <= last + 1e-9))
      faults.add(option,
                 fmt::format("{:g} s is in neither recording: they go from {:g} to {:g} s", *t,
                             earliest, last),
                 "give a time within these", "film.time");
  faults.check();
  times.waits = true;
  if (!times.is_film && !times.at) times.at = last;
  if (!times.from) times.from = first;
  if (!times.to) times.to = last;
  std::vector<FilmedRun> runs;
  for (const auto* file : {&left, &right}) {
    runs.push_back(film_recording(*file, times));
    runs.back().name = file->stem().string();
  }
  return runs;
}

FilmedRun film_run(const RobotOptions& options, const FilmTimes& times, const std::string& camera,
                   Progress& progress) {
  if (!is_recording(options.model)) return simulate_for_film(options, times, camera, progress);
  DiagnosticList faults;
  check_recorded(options, faults);
  faults.check();
  return film_recording(options.model, times);
}

SceneView view_of(const FilmedRun& run) {
  const SimulateInput& input = run.plan.input;
  SceneView view =
      input.scene ? make_scene_view(*input.scene) : make_scene_view(input.robot.robot, run.model());
  for (const RunInstant& instant : run.around) look_ahead(view, run.snapshot(instant));
  for (const RunInstant& instant : run.shown) look_at(view, run.snapshot(instant));
  settle(view);
  for (const RunInstant& instant : run.around)
    measure(view, run.snapshot(instant), Measured::of_run);
  for (const RunInstant& instant : run.shown)
    measure(view, run.snapshot(instant), Measured::of_picture);
  return view;
}

RunInstant instant_of(const RecordedFrame& frame, const Model<double>& model) {
  RunInstant instant;
  instant.x = recorded_state(frame, model);
  instant.coupling_forces = frame.coupling_forces;
  instant.contacts = frame.contacts;
  instant.memory = frame.memory;
  return instant;
}

Snapshot snapshot_of(const SimulateInput& input, SceneCouplings* couplings,
                     const RunInstant& instant) {
  const SceneModel* scene = input.scene.get();
  if (!scene || !couplings) return snapshot_of(input.robot.model, instant.x);
  Snapshot snapshot = snapshot_of(*scene, *couplings, instant.x, instant.coupling_forces);
  const std::vector<char> moves = bodies_with_dofs(scene->model);
  const auto count = static_cast<int>(scene->geometries.size());
  for (const RecordedContact& c : instant.contacts)
    if (c.a >= 0 && c.b >= 0 && c.a < count && c.b < count)
      snapshot.contacts.push_back(shown(*scene, moves, c));
  return snapshot;
}

}  // namespace twinarm
