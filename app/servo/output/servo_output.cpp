#include "app/servo/output/servo_output.h"

#include <fmt/format.h>
#include <unistd.h>

#include "app/data/json_writer.h"
#include "app/data/tables.h"
#include "app/plot/gnuplot.h"
#include "app/record/record_run.h"
#include "app/support/progress.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

std::string microseconds(double seconds) {
  return fmt::format("{:.1f}", 1e6 * seconds);
}

void add_times(TextTable& table, const std::string& name, const TickTimes& times) {
  if (times.count() == 0) return;
  table.add({name, microseconds(times.quantile(0.5)), microseconds(times.quantile(0.99)),
             microseconds(times.quantile(0.999)), microseconds(times.max())});
}

std::string timing_table(const ServoResult& servo) {
  TextTable table({"[us]", "median", "99 %", "99.9 %", "maximum"});
  add_times(table, "processor time of a tick", servo.run.cpu);
  add_times(table, "wall time of a tick", servo.run.wall);
  add_times(table, "wake-up latency", servo.run.late);
  add_times(table, "interval between ticks", servo.run.interval);
  add_times(table, "empty loop: processor time", servo.empty.cpu);
  add_times(table, "empty loop: wake-up latency", servo.empty.late);
  add_times(table, "empty loop: interval between ticks", servo.empty.interval);
  std::string text = table.str();
  text += fmt::format("deadline misses: {} of {}", servo.run.overruns, servo.run.cpu.count());
  if (servo.empty.cpu.count() > 0)
    text +=
        fmt::format("; of the empty loop: {} of {}", servo.empty.overruns, servo.empty.cpu.count());
  if (servo.run.slipped > 0)
    text += fmt::format("\nlost ticks: {} (delay beyond {} ticks)", servo.run.slipped,
                        ServoClock::kMaxBehind);
  return text + "\n";
}

void write_figures(JsonWriter& json, const char* name, const TickFigures& figures) {
  const auto times_of = [&json](const TickTimes& times) {
    return [&json, &times] {
      json.object({{"median", times.quantile(0.5)},
                   {"p99", times.quantile(0.99)},
                   {"p999", times.quantile(0.999)},
                   {"largest", times.max()},
                   {"mean", times.mean()}});
    };
  };
  json.key(name).object({{"ticks", figures.cpu.count()},
                         {"cpu", times_of(figures.cpu)},
                         {"wall", times_of(figures.wall)},
                         {"late", times_of(figures.late)},
                         {"interval", times_of(figures.interval)},
                         {"overruns", figures.overruns},
                         {"slipped", figures.slipped}});
}

// Duration [us] and share [%] of all ticks, in bins of a quarter octave.
std::vector<std::vector<double>> columns_of(const TickTimes& times) {
  constexpr int kTogether = 4;
  std::vector<std::vector<double>> columns(2);
  for (int bin = 0; bin + kTogether <= TickTimes::kBins; bin += kTogether) {
    long count = 0;
    for (int i = 0; i < kTogether; ++i) count += times.count(bin + i);
    columns[0].push_back(1e6 * TickTimes::upper_edge(bin + kTogether / 2));
    columns[1].push_back(100.0 * static_cast<double>(count) /
                         static_cast<double>(std::max(1L, times.count())));
  }
  return columns;
}

// One panel: bars for the run and for the empty loop.
std::string panel(Gnuplot& gnuplot, const std::string& label, const TickTimes& run,
                  const TickTimes& empty, double limit, const std::string& limit_name) {
  std::string script = fmt::format(
      "set xlabel {}\nset ylabel 'share of all ticks [%]'\nset logscale xy\n"
      "set xrange [0.1:20000]\nset yrange [{}:150]\nset format y '%g'\nset format x '%g'\n",
      in_quotes(label), 50.0 / static_cast<double>(std::max(1L, run.count())));
  script += fmt::format(
      "set arrow 1 from {0},graph 0 to {0},graph 0.9 nohead dashtype 2 lc rgb '{1}'\n"
      "set label 1 {2} at {0},graph 0.94 center front tc rgb '{1}'\n",
      limit, palette::faint, in_quotes(limit_name));
  script += fmt::format(
      "plot {} using 1:($2 > 0 ? $2 : 1/0) with impulses lw 3 lc rgb '{}' title 'with the robot'",
      gnuplot.data(columns_of(run)), palette::dvr);
  if (empty.count() > 0)
    script += fmt::format(
        ", {} using ($1*1.06):($2 > 0 ? $2 : 1/0) with impulses lw 3 lc rgb '{}' title 'an empty "
        "loop'",
        gnuplot.data(columns_of(empty)), palette::kvr);
  return script + "\nunset arrow 1\nunset label 1\n";
}

}  // namespace

std::string live_table(const LiveSummary& summary) {
  std::string text =
      fmt::format("{}\ndevice: {}\n{}\n\n{:.3f} s, {} ticks of {} s", summary.scene, summary.device,
                  summary.force_feedback, summary.duration, summary.ticks, summary.step);
  if (summary.silences > 0)
    text += fmt::format("; device timeouts: {}, ticks held: {}, released: {}", summary.silences,
                        summary.held, summary.released);
  text += "\n\n";
  TextTable tracking({"|q_K - q_D| [deg]", "maximum", "mean"});
  for (std::size_t j = 0; j < summary.joints.size(); ++j)
    tracking.add({summary.joints[j], fmt::format("{:.3f}", summary.max_error[j] / kDegree),
                  fmt::format("{:.3f}", summary.mean_error(j) / kDegree)});
  text += tracking.str();
  text += fmt::format("\nmaximum torque of motors 1, 2, 3: {:.1f}, {:.1f}, {:.1f} mN m\n",
                      1e3 * summary.max_torque[0], 1e3 * summary.max_torque[1],
                      1e3 * summary.max_torque[2]);
  if (summary.real_time) text += "\n" + timing_table(summary.servo);
  if (!summary.servo.refused.empty()) text += "denied: " + summary.servo.refused + "\n";
  if (!summary.servo.finite) text += "state diverged: the run ended there\n";
  if (!summary.recording.empty())
    text += fmt::format("recording: {}\n", summary.same_bits
                                               ? "re-simulated from the log, bit-exact"
                                               : "ends in another state than the live run");
  return text;
}

std::string live_json(const LiveSummary& summary) {
  return answer_text([&](JsonWriter& json) {
    json.members({{"scene", summary.scene},
                  {"device", summary.device},
                  {"mapping", summary.mapping},
                  {"step", summary.step},
                  {"duration", summary.duration},
                  {"ticks", summary.ticks},
                  {"silences", summary.silences},
                  {"held", summary.held},
                  {"released", summary.released}});
    json.key("tracking").object([&] {
      for (std::size_t j = 0; j < summary.joints.size(); ++j)
        json.key(summary.joints[j])
            .object({{"max", summary.max_error[j]}, {"mean", summary.mean_error(j)}});
    });
    json.put("largest_torque", summary.max_torque);
    if (summary.real_time) {
      json.put("span", summary.servo.span);
      write_figures(json, "timing", summary.servo.run);
      if (summary.servo.empty.cpu.count() > 0)
        write_figures(json, "empty_loop", summary.servo.empty);
    }
    json.put("finite", summary.servo.finite);
    json.put("log", summary.log);
    if (!summary.recording.empty())
      json.members({{"recording", summary.recording}, {"same_bits", summary.same_bits}});
  });
}

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
  write_whole_file(file, "# " + scene.filename().string() + " driven by the log " +
                             log.filename().string() + "\n" + to_toml(tree));
}

State<double> record_again(const std::filesystem::path& scene,
                           const std::filesystem::path& recording) {
  SimulateOptions options;
  options.robot.model = scene;
  options.record = recording;
  SimulatePlan plan = prepare_simulation(options);
  plan.run.times.clear();
  Progress progress(isatty(STDERR_FILENO) == 0);
  progress.stage("record", 1);
  State<double> end = plan.input.robot.state.x;
  RunWatch watch;
  watch.look = [&](SteppedRun& run) { end = run.simulation().state(); };
  watch.tick = [&](double t) { progress.advance(t, plan.run.duration); };
  record_plan(options, plan, watch);
  progress.finish();
  return end;
}

void draw_timing(const LiveSummary& summary, const std::filesystem::path& file) {
  Gnuplot gnuplot;
  const TickFigures& run = summary.servo.run;
  const TickFigures& empty = summary.servo.empty;
  const std::string script =
      "set multiplot layout 1,2 margins 0.085,0.98,0.17,0.86 spacing 0.1,0.1\n"
      "set key at graph 1,1.14 right top horizontal\n" +
      panel(gnuplot, "processor time of a tick [us]", run.cpu, empty.cpu, 50, "50 us") +
      panel(gnuplot, "wake-up latency [us]", run.late, empty.late, 1e6 * summary.step, "one tick") +
      "unset multiplot\n";
  const std::string title =
      fmt::format("Timing of {} ticks of {} s", run.cpu.count(), summary.step);
  write_whole_file(file, gnuplot.svg("timing", title, 1000, 380, script));
}

}  // namespace twinarm
