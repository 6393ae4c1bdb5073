#include "app/map/map_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/data/json_writer.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

void write_axis(JsonWriter& json, const char* name, const MapAxis& axis, const std::string& unit) {
  std::vector<double> values;
  for (int i = 0; i < axis.count; ++i) values.push_back(axis.at(i));
  const std::string prefix = name;
  json.members({{name, values}, {prefix + "_path", axis.path}, {prefix + "_unit", unit}});
}

std::string or_empty(double value) {
  return std::isfinite(value) ? number_text(value) : "";
}

}  // namespace

std::vector<double> values_of(const MapJob& job, const TileFile& file, MapMeasure measure) {
  const auto which = static_cast<std::size_t>(measure), nx = static_cast<std::size_t>(job.nx());
  std::vector<double> values(nx * static_cast<std::size_t>(job.ny()));
  for (const auto& [place, cell] : file.cells) {
    const auto [iy, ix] = place;
    values[static_cast<std::size_t>(iy) * nx + static_cast<std::size_t>(ix)] = cell[which];
  }
  return values;
}

std::string map_json(const MapJob& job, const TileFile& file, const std::vector<MapCurve>& curves) {
  JsonWriter json;
  json.begin_object();
  write_axis(json, "x", job.x, job.x_unit);
  write_axis(json, "y", job.y, job.y_unit);
  json.members({{"measure", name_of(job.measure)}, {"unit", job.unit}});
  const std::vector<double> values = values_of(job, file, job.measure);
  json.key("values").begin_array();
  for (std::size_t iy = 0; iy < static_cast<std::size_t>(job.ny()); ++iy) {
    const auto row = values.begin() + static_cast<std::ptrdiff_t>(iy * job.x.count);
    json.numbers({row, row + job.x.count});
  }
  json.end_array();
  json.key("curves").list(curves, [&](const MapCurve& curve) {
    json.object({{"name", curve.name}, {"x", curve.x}, {"y", curve.y}});
  });
  json.end_object();
  return json.str() + "\n";
}

std::string map_csv(const MapJob& job, const TileFile& file) {
  const auto with = [](const std::string& name, const std::string& unit) {
    return name + "[" + unit + "]";
  };
  const std::string error_unit = job.error_unit;
  std::string text = with(job.x.path, job.x_unit) + "," + with(job.y.path, job.y_unit) +
                     ",stable[1]," + with("max_error", error_unit) + "," +
                     with("mean_error", error_unit) + ",energy[J],passivity[J]\n";
  std::vector<std::vector<double>> measures;
  for (std::size_t m = 0; m < kMapMeasures.size(); ++m)
    measures.push_back(values_of(job, file, static_cast<MapMeasure>(m)));
  for (int iy = 0; iy < job.ny(); ++iy)
    for (int ix = 0; ix < job.nx(); ++ix) {
      text += number_text(job.x.at(ix)) + "," + number_text(job.y.at(iy));
      const auto cell = static_cast<std::size_t>(iy) * static_cast<std::size_t>(job.nx()) +
                        static_cast<std::size_t>(ix);
      for (const auto& measure : measures) text += "," + or_empty(measure[cell]);
      text += "\n";
    }
  return text;
}

std::string map_words(const MapJob& job, const TileFile& file) {
  const std::vector<double> stable = values_of(job, file, MapMeasure::stable);
  const auto steady = std::count(stable.begin(), stable.end(), 1.0);
  std::string words =
      fmt::format("{} x {} cells, {} of {} stable\n", job.nx(), job.ny(), steady, stable.size());
  if (job.measure == MapMeasure::stable) return words;
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (const double value : values_of(job, file, job.measure))
    if (std::isfinite(value)) least = std::min(least, value), most = std::max(most, value);
  if (least <= most)
    words += fmt::format("{}: {} to {} {}\n", name_of(job.measure), short_number_text(least),
                         short_number_text(most), job.unit);
  return words;
}

}  // namespace twinarm
