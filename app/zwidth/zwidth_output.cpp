// The result of `twinarm zwidth` for people, as JSON and as CSV.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "app/data/json_writer.h"
#include "app/data/text_table.h"
#include "app/zwidth/zwidth.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

std::string short_cell(double value, int digits = 1) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "-";
}

std::string walls_text(const std::vector<WallRow>& walls) {
  TextTable table({"walls of the device alone", "delay", "b", "stable K", "law", "passive K",
                   "Colgate", "passive B", "K with steps", "Abbott"});
  for (const WallRow& row : walls)
    table.add({fmt::format("{:g} Hz", row.device.rate), fmt::format("{} ticks", row.device.delay),
               fmt::format("{:g}", row.device.damping), short_cell(row.stable),
               short_cell(row.stable_law), short_cell(row.passive), short_cell(row.passive_law),
               short_cell(row.passive_damping, 3), short_cell(row.stepped),
               short_cell(row.stepped_law)});
  return table.str() +
         fmt::format(
             "  stable: at B = {:g} N s/m, nobody holding the device; passive K: at B = 0, no "
             "motion of a hand gets energy out;\n  with steps: friction {:g} N and steps of {:g} "
             "mm as well. K in N/m, B and b in N s/m.\n",
             walls.front().wall_damping, walls.front().device.friction,
             1e3 * walls.front().device.resolution);
}

std::string series_text(const std::vector<SeriesRow>& series) {
  TextTable table({"a wall through a coupling [N/m]", "wall", "felt", "in series"});
  for (const SeriesRow& row : series)
    table.add({fmt::format("coupling {:g}", row.coupling), fmt::format("{:g}", row.wall),
               short_cell(row.felt, 2), short_cell(row.law, 2)});
  return table.str();
}

std::string delays_text(const std::vector<DelayRow>& delays) {
  TextTable table({"delay each way", "control", "lowest E [mJ]", "one tick [mJ]", "passive",
                   "E at the end [mJ]", "force [N]", "swing at the end [mm]"});
  for (const DelayRow& row : delays)
    table.add({row.name, row.control ? "yes" : "no", short_cell(1e3 * row.lowest, 3),
               short_cell(1e3 * row.tick_work, 3), row.is_passive() ? "yes" : "NO",
               short_cell(1e3 * row.end, 2), short_cell(row.felt, 2),
               short_cell(1e3 * row.swing, 2)});
  return table.str() +
         "  E: work of the hand on the motors' force; a robot that gives away more than it got has "
         "E < 0.\n  jitter: 80 to 120 ms; loss: 30 % of the packets.\n";
}

std::string follows_text(const std::vector<FollowRow>& follows) {
  TextTable table({"tracking errors", "hand", "joint", "moved by", "max", "mean", "unit"});
  for (const FollowRow& row : follows) {
    const double unit = row.slides ? 1e3 : 180 / std::numbers::pi;
    table.add({row.robot, row.hand, row.joint, row.driven ? "the hand" : "nobody",
               short_cell(unit * row.max, 3), short_cell(unit * row.mean, 3),
               row.slides ? "mm" : "deg"});
  }
  return table.str() +
         "  Implicit joint springs of 50 rad/s at critical damping, of the inertia at the start; "
         "gravity sags.\n";
}

void write(JsonWriter& json, const WallRow& row) {
  json.object({{"rate", row.device.rate},
               {"delay_ticks", row.device.delay},
               {"mass", row.device.mass},
               {"damping", row.device.damping},
               {"friction", row.device.friction},
               {"resolution", row.device.resolution},
               {"wall_damping", row.wall_damping},
               {"stable_stiffness", row.stable},
               {"stable_stiffness_law", row.stable_law},
               {"passive_stiffness", row.passive},
               {"passive_stiffness_law", row.passive_law},
               {"passive_damping", row.passive_damping},
               {"stepped_stiffness", row.stepped},
               {"stepped_stiffness_law", row.stepped_law}});
}

void write(JsonWriter& json, const SeriesRow& row) {
  json.object(
      {{"coupling", row.coupling}, {"wall", row.wall}, {"felt", row.felt}, {"law", row.law}});
}

void write(JsonWriter& json, const DelayRow& row) {
  json.object({{"name", row.name},
               {"delay", row.delay},
               {"jitter", row.jitter},
               {"loss", row.loss},
               {"control", row.control},
               {"lowest_energy", row.lowest},
               {"end_energy", row.end},
               {"tick_work", row.tick_work},
               {"passive", row.is_passive()},
               {"swing", row.swing},
               {"force", row.felt},
               {"t", row.t},
               {"energy", row.energy},
               {"place", row.place}});
}

void write(JsonWriter& json, const FollowRow& row) {
  json.object({{"robot", row.robot},
               {"hand", row.hand},
               {"joint", row.joint},
               {"driven", row.driven},
               {"max", row.max},
               {"mean", row.mean}});
}

template <class Row>
void write_all(JsonWriter& json, const char* key, const std::vector<Row>& rows) {
  json.key(key).list(rows, [&](const Row& row) { write(json, row); });
}

}  // namespace

std::string zwidth_table(const ZwidthResult& result) {
  return walls_text(result.walls) + "\n" + series_text(result.series) + "\n" +
         delays_text(result.delays) + "\n" + follows_text(result.follows);
}

std::string zwidth_json(const ZwidthResult& result) {
  JsonWriter json;
  json.begin_object();
  write_all(json, "walls", result.walls);
  json.key("plane").object({{"stable_B", result.plane.stable_B},
                            {"stable_K", result.plane.stable_K},
                            {"passive_B", result.plane.passive_B},
                            {"passive_K", result.plane.passive_K}});
  write_all(json, "series", result.series);
  write_all(json, "delays", result.delays);
  write_all(json, "following", result.follows);
  json.end_object();
  return json.str() + "\n";
}

std::string zwidth_csv(const ZwidthResult& result) {
  std::string text =
      "rate[Hz],delay[ticks],b[N s/m],B[N s/m],stable_K[N/m],stable_law[N/m],passive_K[N/m],"
      "passive_law[N/m],passive_B[N s/m],stepped_K[N/m],stepped_law[N/m]\n";
  for (const WallRow& row : result.walls) {
    const double numbers[] = {row.device.rate,     static_cast<double>(row.device.delay),
                              row.device.damping,  row.wall_damping,
                              row.stable,          row.stable_law,
                              row.passive,         row.passive_law,
                              row.passive_damping, row.stepped,
                              row.stepped_law};
    for (std::size_t c = 0; c < std::size(numbers); ++c)
      text += (c ? "," : "") + (std::isfinite(numbers[c]) ? number_text(numbers[c]) : "");
    text += "\n";
  }
  return text;
}

}  // namespace twinarm
