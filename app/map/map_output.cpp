#include <fmt/format.h>

#include "app/data/json_writer.h"
#include "app/map/map_results.h"
#include "app/plot/gnuplot.h"
#include "app/support/text.h"

namespace twinarm {
namespace {

void write_axis(JsonWriter& json, const char* name, const MapAxis& axis, const std::string& unit) {
  std::vector<double> values;
  for (int i = 0; i < axis.count; ++i) values.push_back(axis.at(i));
  const std::string prefix = name;
  json.members({{name, values}, {prefix + "_path", axis.path}, {prefix + "_unit", unit}});
}

// One measure of all cells, by MapJob::index().
std::vector<double> values_of(const MapJob& job, const TileFile& file, MapMeasure measure) {
  std::vector<double> values(job.index(0, job.ny()));
  for (const auto& [place, cell] : file.cells)
    values[job.index(place.second, place.first)] = cell[static_cast<std::size_t>(measure)];
  return values;
}

constexpr int kWidth = 980, kHeight = 700;
constexpr const char* kUnstable = "#5A5A5A";
// Even lightness (after viridis); two signs with white at zero.
constexpr const char* kRising =
    "set palette defined (0 '#440154', 0.25 '#3B528B', 0.5 '#21918C', 0.75 '#5EC962', 1 "
    "'#FDE725')\n";
constexpr const char* kSigned =
    "set palette defined (-1 '#2166AC', -0.4 '#92C5DE', 0 '#FFFFFF', 0.4 '#F4A582', 1 '#B2182B')\n";

std::string axis_name(const MapAxis& axis, const std::string& unit) {
  return unit.empty() ? axis.path : axis.path + " [" + unit + "]";
}

std::string tics(const MapAxis& axis) {
  std::string list;
  const auto add = [&](double value, bool labelled) {
    const double place = axis.place_of(value);
    if (place < -1e-9 || place > axis.count - 1 + 1e-9) return;
    list += fmt::format("{}{} {:.8g}{}", list.empty() ? "" : ", ",
                        in_quotes(labelled ? fmt::format("{:.5g}", value) : ""), place,
                        labelled ? "" : " 1");
  };
  if (!axis.log) {
    const double step = round_step((axis.to - axis.from) / 7);
    for (double n = std::ceil(axis.from / step - 1e-9); n * step <= axis.to + 1e-9 * step; ++n)
      add(n * step, true);
    return list;
  }
  const double decades = std::log10(axis.to / axis.from);
  for (int p = static_cast<int>(std::floor(std::log10(axis.from))); std::pow(10, p) <= axis.to; ++p)
    for (int digit = 1; digit < 10; ++digit)
      add(digit * std::pow(10, p), digit == 1 || (decades < 3 && (digit == 2 || digit == 5)));
  return list;
}

struct ColourRange {
  double low = 0, high = 1;
  bool log = false, with_sign = false;
  double scaled(double v) const { return log ? std::log10(v) : v; }
};

// From the 2nd to the 98th percentile.
ColourRange range_of(const std::vector<double>& values, MapMeasure measure) {
  std::vector<double> finite;
  for (const double v : values)
    if (std::isfinite(v)) finite.push_back(v);
  ColourRange range;
  if (finite.empty()) return range;
  std::ranges::sort(finite);
  const auto at = [&](double part) {
    return finite[static_cast<std::size_t>(part * static_cast<double>(finite.size() - 1))];
  };
  range.low = at(0.02);
  range.high = at(0.98);
  range.with_sign = measure == MapMeasure::energy || measure == MapMeasure::passivity;
  range.log = !range.with_sign && range.low > 0 && range.high > 30 * range.low;
  if (range.with_sign) {
    range.high = std::max({std::abs(range.low), std::abs(range.high), 1e-300});
    range.low = -range.high;
  }
  range.low = range.scaled(range.low);
  range.high = range.scaled(range.high);
  if (!(range.high > range.low)) range.high = range.low + std::max(std::abs(range.low), 1e-12);
  return range;
}

// Data rows x, y, value; cells without a value are transparent.
std::string cells(Gnuplot& gnuplot, const MapJob& job, const std::vector<double>& values,
                  const ColourRange& range) {
  std::vector<double> x, y, v;
  for (int iy = 0; iy < job.ny(); ++iy)
    for (int ix = 0; ix < job.nx(); ++ix) {
      const double value = values[job.index(ix, iy)];
      x.push_back(ix);
      y.push_back(iy);
      v.push_back(std::isfinite(value) ? std::clamp(range.scaled(value), range.low, range.high)
                                       : value);
    }
  return gnuplot.data({x, y, v});
}

std::string curve_plots(Gnuplot& gnuplot, const MapJob& job, const std::vector<MapCurve>& curves) {
  constexpr const char* kDashes[] = {"solid", "(9,5)", "(2,4)"};
  std::string plots;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    std::vector<double> x, y;
    for (std::size_t i = 0; i < curves[c].x.size(); ++i) {
      x.push_back(job.x.place_of(curves[c].x[i]));
      y.push_back(job.y.place_of(curves[c].y[i]));
    }
    const std::string data = gnuplot.data({x, y});
    plots += fmt::format(
        ", {} with lines lw 5 lc '#FFFFFF' notitle, {} with lines lw 2.2 dt {} lc "
        "'#000000' title {}",
        data, data, kDashes[std::min<std::size_t>(c, 2)], in_quotes(curves[c].name));
  }
  return plots;
}

std::string colour_box(const MapJob& job, const ColourRange& range) {
  if (job.measure == MapMeasure::stable) return "unset colorbox\n";
  std::string list;
  if (range.log)
    for (int p = static_cast<int>(std::floor(range.low)); p <= range.high; ++p)
      for (const int digit : {1, 2, 5})
        if (const double v = digit * std::pow(10, p); range.scaled(v) >= range.low)
          list += fmt::format("{}'{:.3g}' {:.8g}", list.empty() ? "" : ", ", v, range.scaled(v));
  return fmt::format(
      "set colorbox user origin screen 0.9,0.2 size screen 0.022,0.6\n"
      "set cblabel {} offset 0.5,0\nset cbrange [{:.8g}:{:.8g}]\n{}",
      in_quotes(fmt::format("{} [{}]", name_of(job.measure), job.unit)), range.low, range.high,
      list.empty() ? "" : "set cbtics (" + list + ")\n");
}

std::string script(Gnuplot& gnuplot, const MapJob& job, const TileFile& file,
                   const std::vector<MapCurve>& curves) {
  const std::vector<double> values = values_of(job, file, job.measure);
  const bool is_stable = job.measure == MapMeasure::stable;
  ColourRange range = range_of(values, job.measure);
  if (is_stable) range = {0, 1, false, false};
  const char* palette = is_stable         ? "set palette defined (0 '#5A5A5A', 1 '#CFE3F2')\n"
                        : range.with_sign ? kSigned
                                          : kRising;
  std::string text = fmt::format(
      "set lmargin at screen 0.11\nset rmargin at screen {}\nset tmargin at screen "
      "0.86\nset bmargin at screen 0.12\nset xrange [-0.5:{}]\nset yrange [-0.5:{}]\n"
      "set xtics ({})\nset ytics ({})\nset xlabel {}\nset ylabel {} offset 0.5,0\n"
      "set border 15\nunset grid\nset tics front\n"
      "set key at screen 0.11,0.985 left top horizontal maxcols 2 Left reverse\n",
      is_stable ? 0.97 : 0.87, job.nx() - 0.5, job.ny() - 0.5, tics(job.x), tics(job.y),
      in_quotes(axis_name(job.x, job.x_unit)), in_quotes(axis_name(job.y, job.y_unit)));
  text += fmt::format(
      "set object 1 rectangle from graph 0,0 to graph 1,1 behind fillcolor rgb "
      "'{}' fillstyle solid noborder\n",
      kUnstable);
  text += palette + colour_box(job, range);
  if (is_stable) text += "set cbrange [0:1]\n";
  text += "plot " + cells(gnuplot, job, values, range) + " using 1:2:3 with image notitle" +
          fmt::format(", NaN with points pt 5 ps 1.6 lc '{}' title 'unstable'", kUnstable);
  if (is_stable) text += ", NaN with points pt 5 ps 1.6 lc '#CFE3F2' title 'stable'";
  return text + curve_plots(gnuplot, job, curves) + "\n";
}

}  // namespace

std::string map_json(const MapJob& job, const TileFile& file, const std::vector<MapCurve>& curves) {
  return answer_text([&](JsonWriter& json) {
    write_axis(json, "x", job.x, job.x_unit);
    write_axis(json, "y", job.y, job.y_unit);
    json.members({{"measure", name_of(job.measure)}, {"unit", job.unit}});
    const std::vector<double> values = values_of(job, file, job.measure);
    json.key("values").begin_array();
    for (int iy = 0; iy < job.ny(); ++iy)
      json.value(std::span(values).subspan(job.index(0, iy), job.index(0, 1)));
    json.end_array();
    json.key("curves").list(curves, [&](const MapCurve& curve) {
      json.object({{"name", curve.name}, {"x", curve.x}, {"y", curve.y}});
    });
  });
}

std::string map_csv(const MapJob& job, const TileFile& file) {
  const auto with = [](const std::string& name, const std::string& unit) {
    return name + "[" + unit + "]";
  };
  std::string text = csv_line({with(job.x.path, job.x_unit), with(job.y.path, job.y_unit)}) +
                     ",stable[1]," + with("max_error", job.error_unit) + "," +
                     with("mean_error", job.error_unit) + ",energy[J],passivity[J]\n";
  for (const auto& [place, values] : file.cells)
    text += number_text(job.x.at(place.second)) + "," + number_text(job.y.at(place.first)) +
            csv_fields(values);
  return text;
}

std::string map_words(const MapJob& job, const TileFile& file) {
  const std::vector<double> stable = values_of(job, file, MapMeasure::stable);
  const auto steady = std::ranges::count(stable, 1.0);
  std::string words =
      fmt::format("{} x {} cells, {} of {} stable\n", job.nx(), job.ny(), steady, stable.size());
  if (job.measure == MapMeasure::stable) return words;
  double min = HUGE_VAL, max = -HUGE_VAL;
  for (const double value : values_of(job, file, job.measure))
    if (std::isfinite(value)) min = std::min(min, value), max = std::max(max, value);
  if (min <= max)
    words += fmt::format("{}: {} to {} {}\n", name_of(job.measure), short_number_text(min),
                         short_number_text(max), job.unit);
  return words;
}

// A map as a picture: coloured cells with predicted limits on top. The axes of the drawing count
// cells, for linear and logarithmic axes alike.
std::string map_svg(const MapJob& job, const TileFile& file, const std::vector<MapCurve>& curves) {
  Gnuplot gnuplot;
  const std::string title =
      fmt::format("{} over {} and {}", name_of(job.measure), job.x.path, job.y.path);
  std::string drawn =
      gnuplot.svg("map", title, kWidth, kHeight, script(gnuplot, job, file, curves));
  // A cell is one pixel of an image: no smoothing when it is enlarged.
  const std::string image = "<image ";
  if (const std::size_t at = drawn.find(image); at != std::string::npos)
    drawn.insert(at + image.size(), "style='image-rendering:pixelated' ");
  return drawn;
}

std::string map_png(const MapJob& job, const TileFile& file, const std::vector<MapCurve>& curves) {
  Gnuplot gnuplot;
  return gnuplot.png("map", kWidth, kHeight, script(gnuplot, job, file, curves));
}

}  // namespace twinarm
