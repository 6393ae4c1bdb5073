#include "app/map/map_results.h"

#include <fmt/format.h>

#include <cmath>

#include "app/data/value.h"
#include "app/record/record_run.h"
#include "app/support/interrupt.h"
#include "solver/support/atomic_file.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

// The scene of the cell, with what the command line said in its place.
Value scene_of_cell(const MapJob& job, double x, double y) {
  Value scene = job.scene;
  FaultList faults;
  put_in(job, x, y, scene, faults);
  faults.check();
  if (job.run.step) scene.put("step", Value::of(*job.run.step));
  if (job.run.duration) scene.put("duration", Value::of(*job.run.duration));
  if (!job.run.integrator.empty()) scene.put("integrator", Value::of(job.run.integrator));
  name_files_from_root(job.run.robot.model.parent_path(), scene);
  return scene;
}

CellValues record_cell(const MapJob& job, const OpenedCell& cell,
                       const std::filesystem::path& recording) {
  SimulateOptions options;
  options.robot.model = cell.scene;
  options.record = recording;
  const SimulatePlan plan = prepare_simulation(options);
  CellMeasure measure(plan, measured_joints(*plan.input.scene, job.measured_coupling));
  RunRecorder recorder(
      recording,
      header_of(options, plan,
                {"twinarm", "simulate", cell.scene.string(), "--record", recording.string()}),
      plan);
  RunWatch watch;
  watch.sample = [](double, const State<double>&) {};
  watch.interrupted = is_interrupted;
  watch.look = [&](RunView& run) {
    measure.look(run);
    recorder.look(run);
  };
  watch.tick = [](double) { check_interrupt(); };
  try {
    const SimulateResult result = run_plan(plan.input, plan.run, watch);
    recorder.finish(result.post_mortem ? "stopped: " + result.post_mortem->reason : "done");
    return measure.values(result);
  } catch (const Interrupted&) {
    recorder.finish("interrupted");
    throw;
  }
}

}  // namespace

std::pair<int, int> parse_cell(const std::string& text, const MapJob& job) {
  const std::size_t comma = text.find(',');
  const auto index = [](const std::string& part, int count) {
    const double i = parse_number(part).value_or(-1);
    return i >= 0 && i < count && i == std::floor(i) ? static_cast<int>(i) : -1;
  };
  if (comma != std::string::npos) {
    const int ix = index(text.substr(0, comma), job.nx());
    const int iy = index(text.substr(comma + 1), job.ny());
    if (ix >= 0 && iy >= 0) return {ix, iy};
  }
  throw InputError(
      {{"", 0, "--cell", "'" + text + "' is no cell of this map",
        fmt::format("write IX,IY, from 0,0 to {},{}", job.nx() - 1, job.ny() - 1), "map.cell"}});
}

OpenedCell open_cell(const MapJob& job, int ix, int iy, const std::filesystem::path& recording) {
  OpenedCell cell{ix, iy, job.x.at(ix), job.y.at(iy), {}, recording, ""};
  cell.scene.replace_extension(".toml");
  write_whole_file(cell.scene, fmt::format("# Cell {},{} of a map of {}: {} = {}, {} = {}\n", ix,
                                           iy, job.run.robot.model.filename().string(), job.x.path,
                                           number_text(cell.x), job.y.path, number_text(cell.y)) +
                                   to_toml(scene_of_cell(job, cell.x, cell.y)));
  cell.values = record_cell(job, cell, recording);
  cell.command = "twinarm simulate " + cell.scene.string();
  return cell;
}

}  // namespace twinarm
