// twinarm hand: a scene under a hand device, in real time (docs/understand/phantom_omni.md).
#include <fmt/format.h>
#include <unistd.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "app/command/command.h"
#include "app/command/parser/shared_options.h"
#include "app/device/devices.h"
#include "app/plot/gnuplot.h"
#include "app/scene/read/read_scene.h"
#include "app/servo/output/servo_output.h"
#include "app/support/files.h"
#include "app/support/progress.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

struct HandOptions {
  std::filesystem::path scene;
  std::string device = "virtual:synthetic";  // app/device/devices.h
  std::string mapping = "paper";
  std::optional<double> scale, force_scale;  // of the mapping
  std::optional<double> duration, step;      // [s]; left out: until Ctrl-C, the scene's
  bool simulated = false, fifo = false, control = false, picture = false, record = false;
  std::filesystem::path out = "out/hand";
  bool json = false;
};

void add_options(CLI::App& command, HandOptions& options) {
  add_input_option(command, "scene", options.scene,
                   "TOML, with couplings whose target is \"device\"");
  command
      .add_option("--device", options.device, "who moves it; `--device list` says what there is")
      ->capture_default_str();
  command
      .add_option("--mapping", options.mapping,
                  "paper (theta1, 4, 6), arm (theta1, 2, 3) or cartesian")
      ->capture_default_str();
  command.add_option("--scale", options.scale, "of cartesian: the robot's way over the hand's (4)")
      ->check(above_zero());
  command.add_option("--force-scale", options.force_scale, "of what is felt (1)")
      ->check(zero_or_more());
  command.add_option("--duration", options.duration, "seconds; left out: until Ctrl-C");
  command.add_option("--step", options.step, "seconds, 1e-6 to 0.1; left out: the scene's")
      ->check(above_zero());
  command.add_flag(
      "--simulated", options.simulated,
      "as fast as it goes: the same run on every machine, for a device that is simulated");
  command.add_flag("--fifo", options.fifo,
                   "ask for the real-time scheduler and locked memory; goes on without them");
  command.add_flag("--control", options.control,
                   "every other second an empty loop: what this machine can do at all");
  command.add_flag("--timing", options.picture, "write OUT/timing.svg: histograms of the ticks");
  command.add_flag("--record", options.record,
                   "make the run again from its log, and write OUT/run.twinrec");
  add_file_option(command, "--out", options.out, "folder of the log hand.csv and of what is made")
      ->capture_default_str();
  add_json_option(command, options.json);
}

MappingSpec mapping_of(const HandOptions& options, DiagnosticList& faults) {
  MappingSpec spec;
  const auto found = std::ranges::find(kMappingNames, options.mapping);
  if (found == kMappingNames.end())
    faults.add({"", 0, "--mapping", "'" + options.mapping + "' is none",
                "give paper, arm or cartesian", "option.choice"});
  else
    spec.kind = static_cast<MappingKind>(found - kMappingNames.begin());
  if (options.scale) spec.scale = *options.scale;
  if (options.force_scale) spec.force_scale = *options.force_scale;
  return spec;
}

void gather(const TickResult& view, double step, LiveSummary& summary) {
  ++summary.ticks;
  summary.held += view.mode == DeviceWatchdog::Mode::held ? 1 : 0;
  summary.released += view.mode == DeviceWatchdog::Mode::released ? 1 : 0;
  for (std::size_t j = 0; j < summary.joints.size(); ++j) {
    const double error = std::abs(view.error[j]);
    summary.max_error[j] = std::max(summary.max_error[j], error);
    summary.sum_error[j] += error;
  }
  for (std::size_t j = 0; j < 3; ++j)
    summary.max_torque[j] = std::max(summary.max_torque[j], std::abs(view.felt[j]));
  summary.duration = view.hand.t + step;
}

SceneModel scene_of(const HandOptions& options, DiagnosticList& faults) {
  if (options.scene.extension() != ".toml")
    faults.add({options.scene.string(), 0, "scene", "it is no scene",
                "give a TOML file with couplings whose target is \"device\"", "file.no-scene"});
  if (options.duration && !(*options.duration > 0))
    faults.add({"", 0, "--duration", "must be a positive number of seconds", "give --duration 60",
                "option.not-positive"});
  if (options.control && options.simulated)
    faults.add({"", 0, "--control", "there is nothing to be compared without real time",
                "leave --simulated out", "option.conflict"});
  faults.check();
  return build_scene(read_scene(options.scene));
}

// The run, its ticks gathered and written as they come.
void run_live(LiveRun& run, const HandOptions& options, LiveLog& log, LiveSummary& summary) {
  ServoPlan plan;
  plan.duration = options.duration.value_or(HUGE_VAL);
  plan.real_time = !options.simulated;
  plan.ask_for_fifo = options.fifo;
  plan.control = options.control;
  std::atomic<bool> stop{false};
  Progress progress(options.json || isatty(STDERR_FILENO) == 0);
  progress.stage("hand", 1);
  summary.servo = run_servo(run, plan, stop, [&](SpscRing<TickResult>& ring) {
    for (TickResult view; ring.pop(view);) {
      gather(view, run.step(), summary);
      log.write(view.hand);
    }
    log.flush();
    // Ctrl-C is an ordinary end: what was done is kept. A run without its log is not worth going
    // on.
    if (is_interrupted() || !log.is_whole()) stop = true;
    if (options.duration) progress.advance(std::min(1.0, summary.duration / *options.duration));
  });
  progress.finish();
  forget_interrupt();  // it was the run's: its recording and its picture are made all the same
  summary.silences = run.watch().silences();
}

int run_hand(const HandOptions& options) {
  constexpr int kStopped = 3;
  if (options.device == "list") {
    fmt::print("{}", device_list());
    return 0;
  }
  DiagnosticList faults;
  LiveOptions live;
  live.mapping = mapping_of(options, faults);
  live.step = options.step.value_or(0);
  const SceneModel scene = scene_of(options, faults);
  const std::unique_ptr<HandDevice> device = open_device(options.device);
  LiveRun run(scene, *device, live);

  if (options.picture) require_gnuplot();
  make_folder(options.out);
  require_writable_folder(options.out);
  LiveSummary summary;
  summary.scene = options.scene.string();
  summary.device = device->description();
  summary.mapping = options.mapping;
  summary.felt = run.mapping().force_feedback_description();
  summary.joints = scene.couplings[run.leader()].driven.turned;
  summary.max_error.assign(summary.joints.size(), 0);
  summary.sum_error.assign(summary.joints.size(), 0);
  summary.step = run.step();
  summary.real_time = !options.simulated;
  summary.log = (options.out / "hand.csv").string();
  {
    LiveLog log(summary.log);
    run_live(run, options, log, summary);
    log.finish();
  }
  if (summary.real_time && options.picture) {
    summary.picture = (options.out / "timing.svg").string();
    draw_timing(summary, summary.picture);
  }
  if (options.record && summary.ticks > 0) {
    const std::filesystem::path again = options.out / "scene.toml";
    write_scene_of_log(options.scene, summary.log, run.step(), summary.duration, again);
    summary.recording = (options.out / "run.twinrec").string();
    const State<double> end = record_again(again, summary.recording);
    const State<double>& lived = run.simulation().state();
    summary.same_bits = end.q == lived.q && end.qd == lived.qd;
  }
  fmt::print("{}", options.json ? live_json(summary) + "\n" : live_table(summary));
  return summary.servo.finite ? 0 : kStopped;
}

}  // namespace

Command hand_command() {
  return {
      70, "hand",
      "A scene under a hand device, at 1 kHz in real time: the hand moves the kinematic robot and "
      "feels the springs\n\n"
      "Example:  twinarm hand assets/scenes/hand_and_obstacles.toml --duration 10 --timing",
      add_options, run_hand};
}

}  // namespace twinarm
