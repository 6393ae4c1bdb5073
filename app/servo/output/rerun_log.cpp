#include "app/servo/output/rerun_log.h"

#include <unistd.h>

#include "app/data/value.h"
#include "app/record/record_run.h"
#include "app/support/interrupt.h"
#include "app/support/progress.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
void write_scene_of_log(const std::filesystem::path& scene, const std::filesystem::path& log,
                        double step, double duration, const std::filesystem::path& file) {
  Value tree = read_toml(scene);
  if (Value* couplings = tree.find("coupling"))
    for (Value& coupling : couplings->items)
      if (Value* target = coupling.find("target"); target && target->text == "device")
        target->text = std::filesystem::absolute(log).lexically_normal().string();
  tree.put("step", Value::of(step));
  tree.put("duration", Value::of(duration));
  name_files_from_root(scene.parent_path(), tree);
  write_whole_file(file, "# " + scene.filename().string() + " under the hand of " +
                             log.filename().string() + "\n" + to_toml(tree));
}

State<double> record_again(const std::filesystem::path& scene,
                           const std::filesystem::path& recording) {
  SimulateOptions options;
  options.robot.model = scene;
  options.record = recording;
  SimulatePlan plan = prepare_simulation(options);
  plan.run.times.clear();
  RunRecorder recorder(
      recording,
      header_of(options, plan,
                {"twinarm", "simulate", scene.string(), "--record", recording.string()}),
      plan);
  Progress progress(isatty(STDERR_FILENO) == 0);
  progress.stage("record", 1);
  State<double> end = plan.input.robot.state.x;
  RunWatch watch;
  watch.look = [&](RunView& run) {
    recorder.look(run);
    end = run.simulation().state();
  };
  watch.interrupted = is_interrupted;
  watch.tick = [&](double t) {
    check_interrupt();
    progress.advance(t / plan.run.duration);
  };
  try {
    const SimulateResult result = run_plan(plan.input, plan.run, watch);
    recorder.finish(result.post_mortem ? "stopped: " + result.post_mortem->reason : "done");
  } catch (const Interrupted&) {
    recorder.finish("interrupted");
    throw;
  }
  progress.finish();
  return end;
}

}  // namespace twinarm
