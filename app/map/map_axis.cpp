#include "app/map/map_axis.h"

#include <cmath>
#include <vector>

#include "solver/support/number_text.h"

namespace twinarm {
namespace {

constexpr double kMostCells = 4096;  // along an axis
const char* const kAxisForm =
    "write PATH:FROM:TO:N[:log], as in coupling[0].stiffness:100:1e5:64:log";

std::vector<std::string> at_colons(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(':', begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

}  // namespace

double MapAxis::at(double u) const {
  if (u <= 0) return from;
  if (u >= count - 1) return to;
  const double part = u / (count - 1);
  return log ? from * std::pow(to / from, part) : from + (to - from) * part;
}

double MapAxis::place_of(double value) const {
  const double part =
      log ? std::log(value / from) / std::log(to / from) : (value - from) / (to - from);
  return part * (count - 1);
}

std::string MapAxis::text() const {
  return path + ":" + number_text(from) + ":" + number_text(to) + ":" + std::to_string(count) +
         (log ? ":log" : "");
}

std::optional<MapAxis> parse_axis(const std::string& option, const std::string& text,
                                  FaultList& faults) {
  bool good = true;
  const auto fault = [&](const std::string& rule, const std::string& remedy,
                         std::string_view code) {
    faults.add({"", 0, option, rule, remedy, code});
    good = false;
  };
  const std::vector<std::string> parts = at_colons(text);
  if (parts.size() < 4 || parts.size() > 5 || parts[0].empty()) {
    fault("'" + text + "' is no axis", kAxisForm, "axis.form");
    return std::nullopt;
  }
  MapAxis axis;
  axis.path = parts[0];
  const auto number = [&](std::size_t i, const char* name) {
    const auto value = parse_number(parts[i]);
    if (!value)
      fault(std::string(name) + " '" + parts[i] + "' is not a finite number", kAxisForm,
            "axis.number");
    return value.value_or(0);
  };
  axis.from = number(1, "FROM");
  axis.to = number(2, "TO");
  const double count = number(3, "N");
  if (good && !(axis.from < axis.to))
    fault("goes from " + parts[1] + " to " + parts[2], "give the smaller value first",
          "axis.order");
  if (good && (count < 2 || count > kMostCells || count != std::floor(count)))
    fault("has " + parts[3] + " cells", "give a whole number of them, from 2 to 4096",
          "axis.count");
  axis.log = parts.size() == 5;
  if (axis.log && parts[4] != "log")
    fault("'" + parts[4] + "' is not known", "write log, or leave it out: then it is linear",
          "axis.scale");
  if (good && axis.log && !(axis.from > 0))
    fault("a logarithmic axis begins at " + parts[1], "begin above 0, or leave ':log' out",
          "axis.log-from-zero");
  axis.count = static_cast<int>(good ? count : 0);
  if (!good) return std::nullopt;
  return axis;
}

}  // namespace twinarm
