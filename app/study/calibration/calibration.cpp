
#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/study/calibration/calibration.h"
#include "collision/import/urdf/urdf.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

using nlohmann::ordered_json;

// Throws nlohmann's exception if the value is not an integer of this type.
template <class Number>
Number whole(const nlohmann::json& value) {
  const double number = value.get<double>();
  if (!value.is_number_integer() ||
      number < static_cast<double>(std::numeric_limits<Number>::min()) ||
      number >= static_cast<double>(std::numeric_limits<Number>::max()))
    throw nlohmann::json::other_error::create(501, "expected an integer", &value);
  return value.get<Number>();
}

// Fit of an entry of either file; the name of its objective differs.
void read_fit(const nlohmann::json& item, const char* objective, CalibrationEntry& fit) {
  fit.rate = item.at("rate_hz");
  for (const nlohmann::json& p : item.at("parameters"))
    fit.parameters.push_back({p.at("name"), p.at("low"), p.at("high"), p.at("value")});
  fit.objective = item.at(objective);
  fit.evaluations = whole<long>(item.at("evaluations"));
  fit.numbers = item.at("numbers").get<std::map<std::string, double>>();
}

// JSON with one line for each row of a series: a container of scalars takes one line.
std::string rows_of(const ordered_json& value, std::size_t depth = 0) {
  const auto is_structured = [](const ordered_json& one) { return one.is_structured(); };
  if (std::ranges::none_of(value, is_structured)) return value.dump();
  const bool is_object = value.is_object();
  const std::string line = "\n" + std::string(depth, ' ');
  std::string text;
  for (const auto& [key, item] : value.items()) {
    text += (text.empty() ? "" : ",") + line + ' ';
    if (is_object) text += ordered_json(key).dump() + ": ";
    text += rows_of(item, depth + 1);
  }
  return (is_object ? '{' : '[') + text + line + (is_object ? '}' : ']');
}

Gains with_ratio(double k, double b, const std::map<std::string, double>& numbers) {
  const auto ratio = numbers.find("ratio");
  const double r = ratio == numbers.end() ? 1.0 : ratio->second;
  return {k, b, r * k, r * b};
}

// Passes the document to `read`. `option` of `twinarm study` writes the file again.
template <class Read>
auto read_file(const std::filesystem::path& file, const char* article, const std::string& thing,
               const char* option, Read&& read) {
  const auto fail = [&](const std::string& problem) {
    return InputError({{file.string(), 0, "", problem,
                        fmt::format("run `twinarm study {}`", option), "study.calibration"}});
  };
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) throw fail("cannot open the " + thing);
  std::ifstream stream(file);
  try {
    return read(nlohmann::json::parse(stream));
  } catch (const nlohmann::json::exception& error) {
    throw fail(fmt::format("not {} {}: {}", article, thing, error.what()));
  }
}

}  // namespace

double CalibrationEntry::value(const std::string& parameter) const {
  for (const Parameter& p : parameters)
    if (p.name == parameter) return p.value;
  throw std::out_of_range("calibration entry " + name + " has no parameter " + parameter);
}

Gains CalibrationEntry::gains() const {
  const bool per_link =
      std::ranges::any_of(parameters, [](const Parameter& p) { return p.name == "k1"; });
  if (per_link) return {value("k1"), value("b1"), value("k2"), value("b2")};
  return with_ratio(value("k"), value("b"), numbers);
}

std::optional<Gains> CalibrationEntry::unstable_gains() const {
  const auto k = numbers.find("unstable_k"), b = numbers.find("unstable_b");
  if (k == numbers.end() || b == numbers.end()) return std::nullopt;
  return with_ratio(k->second, b->second, numbers);
}

void CalibrationEntry::keep(const std::array<double, 2>& max_deg,
                            const std::array<double, 2>& mean_deg) {
  for (std::size_t j = 0; j < 2; ++j) {
    numbers[fmt::format("max{}_deg", j + 1)] = max_deg[j];
    numbers[fmt::format("mean{}_deg", j + 1)] = mean_deg[j];
  }
}

const CalibrationEntry& Calibration::entry(const std::string& name) const {
  const auto found = entries.find(name);
  if (found == entries.end())
    throw InputError("calibration", "missing entry '" + name + "'",
                     "run `twinarm study --recalibrate`", "study.calibration");
  return found->second;
}

const CalibrationEntry& Calibration::e3(const std::string& law, double rate) const {
  return entry(fmt::format("E3/{:g}/{}", rate, law));
}

const CalibrationEntry& Calibration::e4(double rate) const {
  return entry(fmt::format("E4/{:g}", rate));
}

Calibration read_calibration(const std::filesystem::path& file) {
  return read_file(file, "a", "calibration", "--recalibrate", [](const nlohmann::json& root) {
    Calibration calibration;
    calibration.optimiser = root.at("optimiser");
    calibration.seed = whole<unsigned>(root.at("seed"));
    for (const nlohmann::json& item : root.at("entries")) {
      const std::string name = item.at("name");
      CalibrationEntry entry;
      entry.name = name;
      read_fit(item, "objective", entry);
      calibration.entries[name] = entry;
    }
    return calibration;
  });
}

std::vector<Identification> read_identifications(const std::filesystem::path& file) {
  return read_file(file, "an", "identification", "--identify", [](const nlohmann::json& root) {
    std::vector<Identification> all;
    for (const nlohmann::json& item : root.at("entries")) {
      Identification& found = all.emplace_back();
      found.row = item.at("row");
      found.law = item.at("law");
      found.fit.name = fmt::format("{}/{}", found.row, found.law);
      read_fit(item, "misfit", found.fit);
      found.singular_values = item.at("singular_values").get<std::vector<double>>();
      found.directions = item.at("directions").get<std::vector<std::vector<double>>>();
      for (const nlohmann::json& p : item.at("profiles")) {
        Profile& profile = found.profiles.emplace_back();
        profile.parameter = p.at("parameter");
        for (const nlohmann::json& point : p.at("points"))
          profile.points.push_back({point.at(0), point.at(1), {point.at(2), point.at(3)}});
      }
    }
    return all;
  });
}

void write_calibration(const Calibration& calibration, const std::filesystem::path& file) {
  ordered_json root;
  root["about"] =
      "Gains that the paper does not publish, found by search. Made by `twinarm study "
      "--recalibrate`; objective, bounds and numbers of each entry: docs/reference/study_files.md.";
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
  write_whole_file(file, rows_of(root) + "\n");
}

void write_identifications(const std::vector<Identification>& all,
                           const std::filesystem::path& file) {
  ordered_json root;
  root["about"] =
      "Identifiability of a coupling's gains from Table 2. Written by `twinarm study --identify`; "
      "format: docs/reference/study_files.md.";
  root["optimiser"] = optimiser_name();
  root["entries"] = ordered_json::array();
  for (const Identification& found : all) {
    ordered_json item = {{"row", found.row},
                         {"law", found.law},
                         {"rate_hz", found.fit.rate},
                         {"misfit", found.fit.objective},
                         {"evaluations", found.fit.evaluations},
                         {"numbers", found.fit.numbers},
                         {"singular_values", found.singular_values},
                         {"directions", found.directions},
                         {"parameters", ordered_json::array()},
                         {"profiles", ordered_json::array()}};
    for (const Parameter& p : found.fit.parameters)
      item["parameters"].push_back(
          {{"name", p.name}, {"low", p.low}, {"high", p.high}, {"value", p.value}});
    for (const Profile& profile : found.profiles) {
      ordered_json points = ordered_json::array();
      for (const ProfilePoint& p : profile.points)
        points.push_back({p.value, p.misfit, p.other_max_deg[0], p.other_max_deg[1]});
      item["profiles"].push_back({{"parameter", profile.parameter}, {"points", points}});
    }
    root["entries"].push_back(item);
  }
  write_whole_file(file, rows_of(root) + "\n");
}

double worst_relative_error(const RunResult& result) {
  if (!result.stable) return 10;
  const auto measured = numbers_of(result);
  const auto published = numbers_of(kPaperTable.at(result.spec.name));
  double worst = 0;
  for (std::size_t i = 0; i < 4; ++i)
    worst = std::max(worst, std::abs(measured[i] / published[i] - 1));
  return worst;
}

RunSpec e3_spec(const std::string& law, double rate) {
  RunSpec spec;
  spec.name = "E3";
  spec.coupling.name = law;
  spec.coupling.printed = true;
  spec.coupling.options.measure =
      law.starts_with("joint") ? SpringSpace::joint : SpringSpace::world;
  spec.coupling.options.damping_sign = law.ends_with("+") ? 1 : -1;
  spec.rate = rate;
  return spec;
}

RunSpec e4_spec(double rate) {
  RunSpec spec;
  spec.name = "E4";
  spec.coupling.name = "printed-linear";
  spec.coupling.type = CouplingSpec::Type::linear;
  spec.coupling.printed = true;
  spec.rate = rate;
  return spec;
}

// All with the published velocity differences; "signed" corrects the damping term only.
RunSpec trial_spec(const std::string& law, double rate) {
  RunSpec spec = law == "printed-linear" ? e4_spec(rate) : e3_spec("world-", rate);
  if (law.starts_with("signed")) spec.coupling.options.damper = Damper::vector_;
  spec.coupling.name = law;
  spec.name = law;
  return spec;
}

// Consistent couplings to a KVR whose velocity is the backward difference of its angles, and
// variants of the damping term.
RunSpec row_spec(const std::string& law, double rate) {
  RunSpec spec;
  spec.name = law;
  spec.rate = rate;
  spec.kvr_rates = TargetRates::backward_difference;
  spec.coupling.name = law;
  if (law.starts_with("linear")) spec.coupling.type = CouplingSpec::Type::linear;
  if (law.starts_with("unsigned") || law.starts_with("older") || law.starts_with("euler")) {
    spec.coupling.printed = true;
    spec.coupling.options.damper =
        law.starts_with("unsigned") ? Damper::unsigned_ : Damper::vector_;
    spec.coupling.options.damping_sign = 1;
  }
  if (law.starts_with("older")) spec.coupling.options.difference = Difference::older;
  if (law.starts_with("euler")) spec.integrator = Integrator::euler;
  return spec;
}

StudyInputs load_inputs(const std::filesystem::path& assets) {
  StudyInputs inputs;
  inputs.settings = read_settings(assets);
  inputs.s103 = read_urdf(inputs.settings.urdf);
  for (const char* name : {"findings_set0", "findings_set1", "findings_set2", "findings_10_14"}) {
    const auto file = assets / "robots" / name / (std::string(name) + ".urdf");
    inputs.findings.emplace(name, StudyRobot::findings(read_urdf(file)));
  }
  return inputs;
}

}  // namespace twinarm
