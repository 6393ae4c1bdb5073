// `twinarm hand`: runs a scene with an input device in real time (docs/use/haptic_loop.md).
#include <fmt/format.h>
#include <unistd.h>
#include <algorithm>
#include <atomic>

#include "app/command/command.h"
#include "app/device/devices.h"
#include "app/plot/gnuplot.h"
#include "app/robot/robot_input.h"
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
  double low_pass = 0;                       // cutoff [Hz]; 0: none
  bool no_passivity = false;
  std::optional<double> duration, step;  // [s]; default: until Ctrl-C, the scene's
  bool simulated = false, fifo = false, empty_loop = false, picture = false, record = false;
  std::filesystem::path out = "out/hand";
  bool json = false;
};

void add_options(const OptionAdder& add, HandOptions& options) {
  add.input("scene", options.scene, ".toml",
            "scene (TOML) with couplings whose target is \"device\"");
  add.group("Device");
  add("--device", options.device, "input device; `--device list` lists them");
  add("--mapping", options.mapping,
      "device to joints: paper (theta1, 4, 6), arm (theta1, 2, 3) or cartesian");
  add("--scale", options.scale,
      "motion scaling of the cartesian mapping, robot over device; default 4")
      ->check(above_zero());
  add("--force-scale", options.force_scale, "scaling of the force feedback; default 1")
      ->check(zero_or_more());
  add("--low-pass", options.low_pass, "cutoff of a low-pass of the force feedback [Hz]; 0: none")
      ->check(zero_or_more());
  add("--no-passivity", options.no_passivity,
      "leave out the passivity controller of the force feedback");
  add.group("Run");
  add("--duration", options.duration, "[s] of the run; default: until Ctrl-C");
  add("--step", options.step, "time step [s], 1e-6 to 0.1; default: the scene's")
      ->check(above_zero());
  add("--simulated", options.simulated,
      "run without real-time pacing: reproducible, for simulated devices");
  add("--fifo", options.fifo, "request SCHED_FIFO and locked memory; continue if they are refused");
  add("--empty-loop", options.empty_loop,
      "alternate each second with an empty loop, to measure the machine's jitter");
  add.group("Output");
  add("--timing", options.picture, "write OUT/timing.svg: histograms of the ticks");
  add("--record", options.record,
      "simulate again from the log and write the recording OUT/run.twinrec");
  add.output("--out", options.out, "", "folder of the log hand.csv and of other output");
  add.json(options.json);
}

MappingSpec mapping_of(const HandOptions& options, DiagnosticList& faults) {
  MappingSpec spec;
  const std::vector<std::string> names(kMappingNames.begin(), kMappingNames.end());
  if (const auto kind = choose("--mapping", options.mapping, names, "mappings", faults))
    spec.kind = static_cast<MappingKind>(*kind);
  if (options.scale) spec.scale = *options.scale;
  if (options.force_scale) spec.force_scale = *options.force_scale;
  return spec;
}

void add_tick(const TickResult& view, double step, LiveSummary& summary) {
  ++summary.ticks;
  summary.held += view.mode == DeviceWatchdog::Mode::held ? 1 : 0;
  summary.released += view.mode == DeviceWatchdog::Mode::released ? 1 : 0;
  for (std::size_t j = 0; j < summary.joints.size(); ++j) {
    const double error = std::abs(view.error[j]);
    summary.max_error[j] = std::max(summary.max_error[j], error);
    summary.sum_error[j] += error;
  }
  for (std::size_t j = 0; j < 3; ++j)
    summary.max_torque[j] = std::max(summary.max_torque[j], std::abs(view.motor_torques[j]));
  summary.duration = view.motion.t + step;
}

SceneModel scene_of(const HandOptions& options, DiagnosticList& faults) {
  if (options.duration) check_positive("--duration", *options.duration, faults, " [s]");
  if (options.empty_loop && options.simulated)
    faults.add("--empty-loop", "measures real time, which --simulated does not keep",
               "leave --simulated out", "option.conflict");
  faults.check();
  return build_scene(read_scene(options.scene));
}

// Runs; summarises and logs the ticks meanwhile.
void run_live(LiveRun& run, const HandOptions& options, LiveLog& log, LiveSummary& summary) {
  const ServoPlan plan{.duration = options.duration.value_or(HUGE_VAL),
                       .real_time = !options.simulated,
                       .ask_for_fifo = options.fifo,
                       .empty_loop = options.empty_loop};
  std::atomic<bool> stop{false};
  Progress progress(options.json || isatty(STDERR_FILENO) == 0);
  progress.stage("hand", 1);
  summary.servo = run_servo(run, plan, stop, [&](SpscRing<TickResult>& ring) {
    for (TickResult view; ring.pop(view);) {
      add_tick(view, run.step(), summary);
      log.write(view.motion);
    }
    log.flush();
    // After Ctrl-C the results so far are kept.
    if (is_interrupted() || !log.is_whole()) stop = true;
    if (options.duration) progress.advance(std::min(1.0, summary.duration / *options.duration));
  });
  progress.finish();
  forget_interrupt();  // it ended the run only: recording and picture are still made
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
  live.force.cutoff = options.low_pass;
  live.force.passive = !options.no_passivity;
  const std::filesystem::path logged = options.out / "scene.toml";
  if (options.record && is_same_file(logged, options.scene))
    faults.add({logged.string(), 0, "--record", "the scene of the log would replace the scene",
                "give another folder with --out", "file.same"});
  const SceneModel scene = scene_of(options, faults);
  const std::unique_ptr<InputDevice> device = open_device(options.device);
  LiveRun run(scene, *device, live);

  if (options.picture) require_gnuplot();
  make_folder(options.out);
  require_writable_folder(options.out);
  LiveSummary summary;
  summary.scene = options.scene.string();
  summary.device = device->description();
  summary.mapping = options.mapping;
  summary.force_feedback = run.mapping().force_feedback_description();
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
    write_scene_of_log(options.scene, summary.log, run.step(), summary.duration, logged);
    summary.recording = (options.out / "run.twinrec").string();
    const State<double> end = record_again(logged, summary.recording);
    const State<double>& live_end = run.simulation().state();
    summary.same_bits = end.q == live_end.q && end.qd == live_end.qd;
  }
  fmt::print("{}", options.json ? live_json(summary) + "\n" : live_table(summary));
  print_wrote(
      {summary.log, summary.recording.empty() ? "" : logged, summary.recording, summary.picture},
      options.json);
  return summary.servo.finite ? 0 : kStopped;
}

}  // namespace

Command hand_command() {
  return {70, "hand",
          "Run a scene in real time with a haptic device, at 1 kHz by default\n\n"
          "Examples:\n"
          "  twinarm hand assets/scenes/hand_and_obstacles.toml --duration 10 --timing\n"
          "  twinarm hand --device list",
          add_options, run_hand};
}

}  // namespace twinarm
