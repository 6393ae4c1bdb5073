// identification.json: written by `twinarm study --identify`, read by the report.
#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/study/calibration/identify.h"
#include "app/study/calibration/whole_number.h"
#include "solver/support/atomic_file.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

using nlohmann::ordered_json;

void write_identifications(const std::vector<Identification>& all,
                           const std::filesystem::path& file) {
  ordered_json root;
  root["about"] =
      "What Table 2 leaves open of a coupling's gains. Made by `twinarm study --identify`; what "
      "stands here: docs/study.md.";
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
  write_whole_file(file, root.dump(1) + "\n");
}

std::vector<Identification> read_identifications(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& rule) {
    return InputError({{file.string(), 0, "", rule, "run `twinarm study --identify`"}});
  };
  std::ifstream stream(file);
  if (!stream) throw fail("the identification cannot be opened");
  try {
    std::vector<Identification> all;
    const nlohmann::json root = nlohmann::json::parse(stream);
    for (const nlohmann::json& item : root.at("entries")) {
      Identification& found = all.emplace_back();
      found.row = item.at("row");
      found.law = item.at("law");
      found.fit.name = fmt::format("{}/{}", found.row, found.law);
      found.fit.rate = item.at("rate_hz");
      found.fit.objective = item.at("misfit");
      found.fit.evaluations = whole<long>(item.at("evaluations"));
      found.fit.numbers = item.at("numbers").get<std::map<std::string, double>>();
      found.singular_values = item.at("singular_values").get<std::vector<double>>();
      found.directions = item.at("directions").get<std::vector<std::vector<double>>>();
      for (const nlohmann::json& p : item.at("parameters"))
        found.fit.parameters.push_back({p.at("name"), p.at("low"), p.at("high"), p.at("value")});
      for (const nlohmann::json& p : item.at("profiles")) {
        Profile& profile = found.profiles.emplace_back();
        profile.parameter = p.at("parameter");
        for (const nlohmann::json& point : p.at("points"))
          profile.points.push_back({point.at(0), point.at(1), {point.at(2), point.at(3)}});
      }
    }
    return all;
  } catch (const nlohmann::json::exception& error) {
    throw fail(fmt::format("it is not an identification: {}", error.what()));
  }
}

}  // namespace twinarm
