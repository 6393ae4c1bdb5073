#include <fmt/format.h>
#include <unistd.h>

#include <chrono>

#include "app/command/commands.h"
#include "app/diagnose/post_mortem.h"
#include "app/record/record_run.h"
#include "app/run/output/simulate_output.h"
#include "app/support/interrupt.h"
#include "app/support/progress.h"
#include "app/support/streams.h"

namespace twinarm {
namespace {

// A bar for those who have waited for two seconds.
class PatientProgress {
 public:
  explicit PatientProgress(double duration) : duration_(duration) {}
  void operator()(double t) {
    using Clock = std::chrono::steady_clock;
    if (!bar_ && Clock::now() - start_ > std::chrono::seconds(2)) {
      bar_.emplace(isatty(STDERR_FILENO) == 0);
      bar_->stage("simulate", 1);
    }
    if (bar_) bar_->advance(t / duration_);
  }

 private:
  double duration_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<Progress> bar_;
};

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

}  // namespace

int run_simulate(const SimulateOptions& options) {
  constexpr int kStopped = 3;
  const SimulatePlan prepared = prepare_simulation(options);
  const SimulateInput& input = prepared.input;
  const RunPlan& plan = prepared.run;
  const std::unique_ptr<RunOutput> output = output_of(options, input, plan);

  std::optional<RunRecorder> recorder;
  if (!options.record.empty())
    recorder.emplace(options.record, header_of(options, prepared, options.command), prepared,
                     options.record_every.value_or(0));
  SimulateResult result;
  try {
    PatientProgress progress(plan.duration);
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
      progress(t);
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
    explain(prepared, header_of(options, prepared, options.command), post_mortem_file(options),
            result);
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

}  // namespace twinarm
