#include "app/study/calibration/calibration.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/study/calibration/whole_number.h"
#include "app/support/output_file.h"
#include "solver/support/atomic_file.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

using nlohmann::ordered_json;

double CalibrationEntry::value(const std::string& parameter) const {
  for (const Parameter& p : parameters)
    if (p.name == parameter) return p.value;
  throw std::out_of_range("calibration entry " + name + " has no parameter " + parameter);
}

Gains CalibrationEntry::gains() const {
  const auto has = [&](const char* parameter) {
    for (const Parameter& p : parameters)
      if (p.name == parameter) return true;
    return false;
  };
  if (has("k1")) return {value("k1"), value("b1"), value("k2"), value("b2")};
  const double k = value("k"), b = value("b");
  const auto ratio = numbers.find("ratio");
  const double r = ratio == numbers.end() ? 1.0 : ratio->second;
  return {k, b, r * k, r * b};
}

const CalibrationEntry& Calibration::entry(const std::string& name) const {
  const auto found = entries.find(name);
  if (found == entries.end())
    throw InputError({{"", 0, "calibration", "there is no entry '" + name + "'",
                       "run `twinarm study --recalibrate`"}});
  return found->second;
}

Calibration read_calibration(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& rule) {
    return InputError({{file.string(), 0, "", rule, "run `twinarm study --recalibrate`"}});
  };
  std::ifstream stream(file);
  if (!stream) throw fail("the calibration cannot be opened");
  try {
    const nlohmann::json root = nlohmann::json::parse(stream);
    Calibration calibration;
    calibration.optimiser = root.at("optimiser");
    calibration.seed = whole<unsigned>(root.at("seed"));
    for (const nlohmann::json& item : root.at("entries")) {
      CalibrationEntry entry;
      entry.name = item.at("name");
      entry.rate = item.at("rate_hz");
      for (const nlohmann::json& p : item.at("parameters"))
        entry.parameters.push_back({p.at("name"), p.at("low"), p.at("high"), p.at("value")});
      entry.objective = item.at("objective");
      entry.evaluations = whole<long>(item.at("evaluations"));
      entry.numbers = item.at("numbers").get<std::map<std::string, double>>();
      calibration.entries[entry.name] = entry;
    }
    return calibration;
  } catch (const nlohmann::json::exception& error) {
    throw fail(fmt::format("it is not a calibration: {}", error.what()));
  }
}

void write_calibration(const Calibration& calibration, const std::filesystem::path& file) {
  ordered_json root;
  root["about"] =
      "Gains that the paper does not publish, found by search. Made by `twinarm study "
      "--recalibrate`; objective, bounds and numbers of each entry: docs/study.md.";
  root["entries"] = ordered_json::array();
  for (const auto& [name, entry] : calibration.entries) {
    ordered_json item = {{"evaluations", entry.evaluations},
                         {"name", name},
                         {"numbers", entry.numbers},
                         {"objective", entry.objective},
                         {"parameters", ordered_json::array()},
                         {"rate_hz", entry.rate}};
    for (const Parameter& p : entry.parameters)
      item["parameters"].push_back(
          {{"high", p.high}, {"low", p.low}, {"name", p.name}, {"value", p.value}});
    root["entries"].push_back(item);
  }
  root["optimiser"] = calibration.optimiser;
  root["seed"] = calibration.seed;
  write_whole_file(file, root.dump(1) + "\n");
}

}  // namespace twinarm
