// `twinarm simulate`.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/command/command.h"
#include "app/command/parser/shared_options.h"
#include "app/diagnose/post_mortem.h"
#include "app/record/record_run.h"
#include "app/run/output/simulate_output.h"
#include "app/run/simulate_input.h"
#include "app/support/files.h"
#include "app/support/progress.h"

namespace twinarm {
namespace {

void add_options(CLI::App& command, SimulateOptions& options) {
  add_robot_options(command, options.robot, "the robot's URDF, or a scene in TOML");
  command.add_option("--duration", options.duration,
                     "seconds; if not given, as long as the scene says");
  command.add_option("--step", options.step,
                     "seconds; 0.001 or the scene's if not given; of dopri5 the longest");
  command.add_option("--integrator", options.integrator,
                     "semi-implicit or the scene's if not given; one of" + integrator_names());
  command.add_option("--contact", options.contact,
                     "how bodies of a scene are kept apart; its own word if not given; one of "
                     "rigid compliant event");
  command.add_option("--tolerance", options.tolerance, "of dopri5, relative and absolute");
  command.add_option("--every", options.every, "a sample each so many seconds");
  command.add_option("--at", options.at, "samples at these times: t1,t2,..");
  add_file_option(command, "--record", options.record, "write a recording of the run to this file");
  command.add_option("--record-every", options.record_every,
                     "seconds between its frames; each step if not given");
  command.add_option("--energy-bound", options.energy_bound,
                     "joules of kinetic energy at which the run stops; inf: none");
  add_file_option(command, "--post-mortem", options.post_mortem,
                  "where the last steps of a run go that stops by itself; in out/ if not "
                  "given");
  add_json_option(command, options.json);
  command.add_flag("--csv", options.csv, "print one row a sample on stdout");
}

std::unique_ptr<RunOutput> output_of(const SimulateOptions& options, const SimulateInput& input,
                                     const RunPlan& plan) {
  if (options.json) return json_output(input, plan);
  if (options.csv) return csv_output(input);
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
  const std::unique_ptr<RunOutput> output = output_of(options, input, plan);

  std::optional<RunRecorder> recorder;
  if (!options.record.empty())
    recorder.emplace(options.record, header_of(options, prepared, typed), prepared,
                     options.record_every.value_or(0));
  SimulateResult result;
  try {
    Progress progress(false, Progress::kPatience);
    progress.stage("simulate", 1);
    RunWatch watch;
    watch.warn = [](const std::string& text) { say("twinarm: warning: {}\n", text); };
    watch.alarm = [&](const Alarm& alarm) {
      const std::string words = alarm_words(alarm, prepared);
      say("twinarm: alarm: {}\n", words);
      if (recorder) recorder->alarm(words);
      return words;
    };
    watch.sample = [&](double t, const State<double>& x) { output->sample(t, x); };
    watch.interrupted = is_interrupted;
    watch.tick = [&](double t) {
      check_interrupt();
      progress.advance(t / plan.duration);
    };
    if (recorder) watch.look = [&](RunView& run) { recorder->look(run); };
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
  if (!result.post_mortem) return 0;
  const PostMortem& found = *result.post_mortem;
  say("twinarm: stopped after t = {} s, in step {}: {}", found.time, found.step, found.reason);
  if (!found.field.empty())
    say("; first in '{}' of link '{}' (joint '{}')", found.field, found.body, found.joint);
  if (!found.fastest_joint.empty()) say("; the fastest was joint '{}'", found.fastest_joint);
  say("\n");
  for (const std::string& words : found.words) say("twinarm:   {}\n", words);
  return kStopped;
}

}  // namespace

Command simulate_command() {
  return {60, "simulate",
          "Let a robot or a scene move, under gravity, couplings, constant torques and forces\n\n"
          "Example:  twinarm simulate assets/robots/puma560/puma560.urdf --duration 1 --every 0.1",
          add_options, run_simulate};
}

}  // namespace twinarm
