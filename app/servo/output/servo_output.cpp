#include "app/servo/output/servo_output.h"

#include <fmt/format.h>

#include "app/data/json_writer.h"
#include "app/data/text_table.h"

namespace twinarm {
namespace {

constexpr double kDegree = 0.017453292519943295;

std::string microseconds(double seconds) {
  return fmt::format("{:.1f}", 1e6 * seconds);
}

void add_times(TextTable& table, const std::string& name, const TickTimes& times) {
  if (times.count() == 0) return;
  table.add({name, microseconds(times.quantile(0.5)), microseconds(times.quantile(0.99)),
             microseconds(times.quantile(0.999)), microseconds(times.largest())});
}

std::string timing_table(const ServoResult& servo) {
  TextTable table({"[us]", "median", "99 %", "99.9 %", "largest"});
  add_times(table, "processor time of a tick", servo.run.cpu);
  add_times(table, "wall time of a tick", servo.run.wall);
  add_times(table, "woken late", servo.run.late);
  add_times(table, "from tick to tick", servo.run.interval);
  add_times(table, "empty loop: processor time", servo.empty.cpu);
  add_times(table, "empty loop: woken late", servo.empty.late);
  add_times(table, "empty loop: from tick to tick", servo.empty.interval);
  std::string text = table.str();
  text += fmt::format("overruns (ticks not done by the next deadline): {} of {}",
                      servo.run.overruns, servo.run.cpu.count());
  if (servo.empty.cpu.count() > 0)
    text +=
        fmt::format("; of the empty loop: {} of {}", servo.empty.overruns, servo.empty.cpu.count());
  if (servo.run.slipped > 0)
    text += fmt::format(
        "\ntime has slipped by {} ticks: the machine was away for longer than could "
        "be made up for",
        servo.run.slipped);
  return text + "\n";
}

void write_figures(JsonWriter& json, const char* name, const TickFigures& figures) {
  const auto times_of = [&json](const TickTimes& times) {
    return [&json, &times] {
      json.object({{"median", times.quantile(0.5)},
                   {"p99", times.quantile(0.99)},
                   {"p999", times.quantile(0.999)},
                   {"largest", times.largest()},
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

void write_files(JsonWriter& json, const LiveSummary& summary) {
  json.key("log").text(summary.log);
  if (summary.recording.empty()) return;
  json.members({{"recording", summary.recording}, {"same_bits", summary.same_bits}});
}

}  // namespace

std::string live_table(const LiveSummary& summary) {
  std::string text =
      fmt::format("{}\nhand: {}\n{}\n\n{:.3f} s, {} ticks of {} s", summary.scene, summary.device,
                  summary.felt, summary.duration, summary.ticks, summary.step);
  if (summary.silences > 0)
    text += fmt::format("; the device fell silent {} times: {} ticks held, {} released",
                        summary.silences, summary.held, summary.released);
  text += "\n\n";
  TextTable tracking({"|q_K - q_D| [deg]", "largest", "mean"});
  for (std::size_t j = 0; j < summary.joints.size(); ++j)
    tracking.add(
        {summary.joints[j], fmt::format("{:.3f}", summary.largest_error[j] / kDegree),
         fmt::format("{:.3f}", summary.sum_error[j] /
                                   static_cast<double>(std::max(1L, summary.ticks)) / kDegree)});
  text += tracking.str();
  text += fmt::format("\nlargest torque of the motors 1, 2, 3: {:.1f}, {:.1f}, {:.1f} mN m\n",
                      1e3 * summary.largest_torque[0], 1e3 * summary.largest_torque[1],
                      1e3 * summary.largest_torque[2]);
  if (summary.real_time) text += "\n" + timing_table(summary.servo);
  if (!summary.servo.refused.empty()) text += "not granted: " + summary.servo.refused + "\n";
  if (!summary.servo.finite) text += "the robot left all bounds: the run ended there\n";
  if (!summary.log.empty()) text += "log: " + summary.log + "\n";
  if (!summary.recording.empty())
    text += fmt::format("recording: {} ({})\n", summary.recording,
                        summary.same_bits ? "made again from the log, with the same bits"
                                          : "it does not end as the live run did");
  if (!summary.picture.empty()) text += "picture: " + summary.picture + "\n";
  return text;
}

std::string live_json(const LiveSummary& summary) {
  JsonWriter json;
  json.begin_object();
  json.members({{"scene", summary.scene},
                {"device", summary.device},
                {"mapping", summary.mapping},
                {"step", summary.step},
                {"duration", summary.duration},
                {"ticks", summary.ticks},
                {"silences", summary.silences},
                {"held", summary.held},
                {"released", summary.released}});
  json.key("tracking").begin_object();
  for (std::size_t j = 0; j < summary.joints.size(); ++j)
    json.key(summary.joints[j])
        .object(
            {{"max", summary.largest_error[j]},
             {"mean", summary.sum_error[j] / static_cast<double>(std::max(1L, summary.ticks))}});
  json.end_object();
  json.key("largest_torque")
      .numbers({summary.largest_torque.begin(), summary.largest_torque.end()});
  if (summary.real_time) {
    json.key("span").number(summary.servo.span);
    write_figures(json, "timing", summary.servo.run);
    if (summary.servo.empty.cpu.count() > 0) write_figures(json, "empty_loop", summary.servo.empty);
  }
  json.key("finite").boolean(summary.servo.finite);
  write_files(json, summary);
  json.end_object();
  return json.str();
}

}  // namespace twinarm
