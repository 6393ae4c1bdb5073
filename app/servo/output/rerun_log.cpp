#include "app/servo/output/rerun_log.h"

#include <unistd.h>

#include "app/data/toml_text.h"
#include "app/record/record_run.h"
#include "app/support/interrupt.h"
#include "app/support/progress.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

void put_number(TomlValue& table, const std::string& key, double number) {
  TomlValue* member = table.find(key);
  if (!member) {
    table.members.emplace_back();
    member = &table.members.back();
    member->key = key;
  }
  member->kind = TomlValue::Kind::number;
  member->number = number;
}

}  // namespace

void write_scene_of_log(const std::filesystem::path& scene, const std::filesystem::path& log,
                        double step, double duration, const std::filesystem::path& file) {
  TomlValue tree = read_toml(scene);
  if (TomlValue* couplings = tree.find("coupling"))
    for (TomlValue& coupling : couplings->items)
      if (TomlValue* target = coupling.find("target"); target && target->text == "device")
        target->text = std::filesystem::absolute(log).lexically_normal().string();
  put_number(tree, "step", step);
  put_number(tree, "duration", duration);
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
