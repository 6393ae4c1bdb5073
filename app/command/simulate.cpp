#include "app/command/command.h"
#include "app/diagnose/post_mortem.h"
#include "app/record/record_run.h"
#include "app/run/output/simulate_output.h"
#include "app/run/simulate_input.h"
#include "app/support/files.h"
#include "app/support/progress.h"

namespace twinarm {
namespace {

void add_options(const OptionAdder& add, SimulateOptions& options) {
  add.robot(options.robot, "robot (URDF) or scene (TOML)");
  add.group("Run");
  add("--duration", options.duration,
      "simulated time [s]; default: the scene's; required for a URDF");
  add("--step", options.step,
      "time step [s], of dopri5 the largest; default: the scene's, or 0.001");
  add("--integrator", options.integrator,
      "integration method; default: the scene's, or semi-implicit; one of: " + integrator_names());
  add("--contact", options.contact,
      "contact model: rigid, compliant or event; default: the scene's");
  add("--tolerance", options.tolerance, "relative and absolute tolerance of dopri5; default 1e-9");
  add("--energy-bound", options.energy_bound,
      "stop when the kinetic energy exceeds this [J]; inf: never; default: 1e12 times the start's, "
      "after an energy alarm 1e4 times");
  add.group("Output");
  add("--every", options.every, "output interval [s]; default: start and end");
  add("--at", options.at, "output times: t1,t2,.. [s]");
  add.json(options.json);
  add("--csv", options.csv, "print one CSV row per output time");
  add("--forces", options.forces,
      "with accelerations, joint reactions, forces of constraints, springs and contacts");
  add.output("--record", options.record, ".twinrec", "write a recording of the run");
  add("--record-every", options.record_every,
      "interval between recorded frames [s]; default: each step");
  add.output("--post-mortem", options.post_mortem, ".twinrec",
             "file for the last 1,000 steps of a diverged run; default: in out/post_mortem");
}

std::unique_ptr<RunOutput> output_of(const SimulateOptions& options, const SimulateInput& input,
                                     const RunPlan& plan, ForceSeries* forces) {
  if (options.json) return json_output(input, plan, forces);
  if (options.csv) return csv_output(input, forces);
  return table_output(input, plan);
}

std::filesystem::path post_mortem_file(const SimulateOptions& options) {
  if (!options.post_mortem.empty()) return options.post_mortem;
  return std::filesystem::path("out") / "post_mortem" /
         (options.robot.model.stem().string() + ".twinrec");
}

int run_simulate(const SimulateOptions& options, const Words& typed) {
  constexpr int kStopped = 3;
  const SimulatePlan prepared = prepare_simulation(options);
  const SimulateInput& input = prepared.input;
  const RunPlan& plan = prepared.run;
  print_warnings(input.robot.warnings, options.json);
  std::optional<ForceSeries> forces;
  if (options.forces) forces.emplace(options);
  const std::unique_ptr<RunOutput> output =
      output_of(options, input, plan, forces ? &*forces : nullptr);

  std::optional<RunRecorder> recorder;
  if (!options.record.empty())
    recorder.emplace(options.record, header_of(options, prepared, typed), prepared,
                     options.record_every.value_or(0));
  SimulateResult result;
  try {
    Progress progress(false, Progress::kPatience);
    progress.stage("simulate", 1);
    RunWatch watch;
    watch.warn = [](const std::string& text) { print_error("twinarm: warning: {}\n", text); };
    watch.alarm = [&](const Alarm& alarm) {
      const std::string words = alarm_words(alarm, prepared);
      print_error("twinarm: alarm: {}\n", words);
      if (recorder) recorder->alarm(words);
      return words;
    };
    watch.sample = [&](double t, const State<double>& x) { output->sample(t, x); };
    watch.interrupted = is_interrupted;
    watch.tick = [&](double t) { progress.advance(t, plan.duration); };
    watch.look = [&](SteppedRun& run) {
      if (recorder) recorder->look(run);
      if (forces) forces->keep(run);
    };
    result = run_plan(input, plan, watch);
  } catch (const Interrupted&) {
    if (recorder) recorder->finish("interrupted");
    throw;
  }
  if (recorder)
    recorder->finish(result.post_mortem ? "stopped: " + result.post_mortem->reason : "done");
  if (result.post_mortem)
    explain(prepared, header_of(options, prepared, typed), post_mortem_file(options), result);
  output->end(result);
  print_wrote({options.record}, options.json || options.csv);
  if (!result.post_mortem) return 0;
  const PostMortem& found = *result.post_mortem;
  print_error("twinarm: stopped after t = {} s, in step {}: {}", found.time, found.step,
              found.reason);
  if (!found.field.empty())
    print_error("; first in '{}' of link '{}' (joint '{}')", found.field, found.body, found.joint);
  if (!found.fastest_joint.empty()) print_error("; fastest joint '{}'", found.fastest_joint);
  print_error("\n");
  for (const std::string& words : found.words) print_error("twinarm:   {}\n", words);
  return kStopped;
}

}  // namespace

Command simulate_command() {
  return {60, "simulate",
          "Simulate a robot or a scene\n\n"
          "Examples:\n"
          "  twinarm simulate assets/robots/puma560/puma560.urdf --duration 1 --every 0.1\n"
          "  twinarm simulate assets/scenes/slider_crank.toml --every 0.01 --csv --forces\n"
          "  twinarm simulate assets/scenes/double_pendulum.toml --duration 10 --record "
          "out/run.twinrec",
          add_options, run_simulate};
}

}  // namespace twinarm
