// CSV and JSON output of the study.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/data/json_writer.h"
#include "app/study/findings/findings.h"
#include "app/study/report/report.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

struct Column {
  std::string header;
  const std::vector<double>* values;
};

std::string csv(const std::vector<Column>& columns) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (std::size_t c = 0; c < columns.size(); ++c)
    fmt::format_to(out, "{}{}", columns[c].header, c + 1 == columns.size() ? '\n' : ',');
  const std::size_t rows = columns.front().values->size();
  for (std::size_t n = 0; n < rows; ++n)
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const std::vector<double>& values = *columns[c].values;
      if (n < values.size()) fmt::format_to(out, "{}", values[n]);  // else empty
      text.push_back(c + 1 == columns.size() ? '\n' : ',');
    }
  return fmt::to_string(text);
}

std::string file_name(std::string name) {
  for (char& c : name)
    if (c == '/' || c == '\\' || c == ' ') c = '_';
  return name + ".csv";
}

std::string run_csv(const RunResult& run) {
  const TrackingSeries& series = run.series;
  std::vector<Column> columns{{"t[s]", &series.t}};
  const auto add = [&](const char* name, const std::vector<std::vector<double>>& values,
                       const char* unit) {
    for (std::size_t j = 0; j < values.size(); ++j)
      columns.push_back({fmt::format("{}/joint{}[{}]", name, j + 1, unit), &values[j]});
  };
  add("q_K", series.q_K, "rad");
  add("q_D", series.q_D, "rad");
  add("pull", series.coupling_force, run.spec.coupling_force_unit());
  return csv(columns);
}

std::string obstacle_csv(const ObstacleRun& run) {
  const auto radians = [](std::vector<double> deg) {
    for (double& x : deg) x = x * std::numbers::pi / 180;
    return deg;
  };
  const std::vector<double> q[] = {radians(run.q_K_deg[0]), radians(run.q_K_deg[1]),
                                   radians(run.q_D_deg[0]), radians(run.q_D_deg[1])};
  return csv({{"t[s]", &run.t},
              {"q_K/joint1[rad]", &q[0]},
              {"q_K/joint2[rad]", &q[1]},
              {"q_D/joint1[rad]", &q[2]},
              {"q_D/joint2[rad]", &q[3]},
              {fmt::format("pull[{}]", run.spec.coupling_force_unit()), &run.coupling},
              {"contact_force[N]", &run.contact_force},
              {"penetration[m]", &run.penetration},
              {"beyond[m]", &run.beyond}});
}

using nlohmann::ordered_json;

// nlohmann writes the shortest text that reads back the same double, and null if it is not finite.
template <class Range, class F>
ordered_json list_of(const Range& range, F&& json_of) {
  ordered_json list = ordered_json::array();
  for (const auto& item : range) list.push_back(json_of(item));
  return list;
}

ordered_json by_joint(const std::array<double, 2>& values) {
  return {{"joint1", values[0]}, {"joint2", values[1]}};
}

ordered_json gains_json(const Gains& gains) {
  return {{"k1", gains.k1}, {"b1", gains.b1}, {"k2", gains.k2}, {"b2", gains.b2}};
}

ordered_json run_json(const RunResult& run) {
  const RunSpec& spec = run.spec;
  // Those of an unstable run are rounding errors that have grown.
  const auto errors = [&](const std::array<double, 2>& deg) {
    return run.stable ? by_joint(deg) : by_joint({NAN, NAN});
  };
  return {{"title", spec.title},
          {"coupling", coupling_words(spec.coupling)},
          {"discretization", discretization_name(spec.coupling)},
          {"rate", spec.rate},
          {"step", spec.step()},
          {"gains", gains_json(spec.gains)},
          {"max_deg", errors(run.max_deg)},
          {"mean_deg", errors(run.mean_deg)},
          {"stable", run.stable},
          {"prediction",
           {{"frequency", run.frequency},
            {"step_limit", run.step_limit},
            {"peak_deg", by_joint(run.peak_deg)},
            {"max_deg", by_joint(run.motion_max_deg)},
            {"mean_deg", by_joint(run.motion_mean_deg)}}}};
}

ordered_json reproduction_json(const RunResult& run) {
  ordered_json json = run_json(run);
  const PaperRow& paper = kPaperTable.at(run.spec.name);
  json["paper"] = {{"max_deg", by_joint(paper.max_deg)}, {"mean_deg", by_joint(paper.mean_deg)}};
  json["worst_relative_error"] = worst_relative_error(run);
  json["calibrated"] = run.spec.name == "E3" || run.spec.name == "E4";
  return json;
}

// Format: docs/reference/study_files.md.
ordered_json ensemble_json(const Ensemble& ensemble) {
  ordered_json json = {{"seeds", ensemble.seeds}, {"unstable", ensemble.unstable}};
  const auto add = [&](const char* name, double Distribution::*number) {
    for (const auto& [row, values] :
         {std::pair{"max_deg", &ensemble.max_deg}, {"mean_deg", &ensemble.mean_deg}})
      json[name][row] = by_joint({(*values)[0].*number, (*values)[1].*number});
  };
  add("median_deg", &Distribution::median);
  add("p10_deg", &Distribution::p10);
  add("p90_deg", &Distribution::p90);
  add("percentile_of_published", &Distribution::percentile);
  return json;
}

ordered_json variant_json(const RunResult& run) {
  ordered_json json = {{"name", run.spec.name}};
  json.update(run_json(run));
  return json;
}

ordered_json obstacle_json(const ObstacleRun& run) {
  return {{"name", run.spec.coupling.name},
          {"discretization", discretization_name(run.spec.coupling)},
          {"gains", gains_json(run.spec.gains)},
          {"largest_penetration", run.max_penetration},
          {"largest_beyond", run.max_beyond},
          {"largest_coupling_force", run.max_coupling},
          {"coupling_force_unit", run.spec.coupling_force_unit()},
          {"largest_contact_force", run.max_force},
          {"target_radius_ratio", run.target_radius_ratio},
          {"target_radius_limit", run.target_radius_limit},
          {"limit_exceeded_at", run.exceeded_at},
          {"finite", run.finite},
          {"contact_begin", run.contact_begin},
          {"contact_end", run.contact_end}};
}

ordered_json search_json(const Calibration& calibration, double rate) {
  ordered_json json = {{"rate", rate}, {"e3", ordered_json::object()}};
  for (const char* law : {"joint+", "joint-", "world+", "world-"})
    json["e3"][law] = calibration.e3(law, rate).objective;
  json["e4"] = calibration.e4(rate).objective;
  return json;
}

ordered_json finding_json(const Finding& finding) {
  return {{"section", finding.section},
          {"claim", finding.claim},
          {"measured", finding.measured},
          {"holds", finding.holds}};
}

ordered_json evidence_json(const Evidence& e) {
  const auto figure = [](const std::string& run, double share) -> ordered_json {
    const PaperStatement& statement = statement_on(run);
    return {{"figure", statement.figure},
            {"share", share},
            {"verdict", verdict_words(verdict_of(statement, share))}};
  };
  return {{"row", e.row},
          {"law", e.law},
          {"rate", e.rate},
          {"gains", gains_json(e.gains)},
          {"arm2_mass_scale", e.arm2_mass_scale},
          {"fitted_parameters", e.parameters},
          {"used", e.is_used},
          {"damping_ratio", e.damping_ratio},
          {"misfit", e.misfit},
          {"automatic", figure(e.row, e.figure)},
          {"user", figure(e.user_row(), e.user_figure)},
          {"user_numbers_inside", e.user_numbers}};
}

ordered_json recording_json(const StudyRecording& run) {
  return {{"name", run.name},
          {"scene", run.scene.string()},
          {"recording", run.recording.string()},
          {"page", run.page.string()},
          {"apart_deg", run.apart_deg}};
}

// Format: docs/use/run_the_study.md.
ordered_json identification_json(const Identification& found) {
  ordered_json json = {{"row", found.row},
                       {"law", found.law},
                       {"rate", found.fit.rate},
                       {"misfit", found.fit.objective},
                       {"numbers", found.fit.numbers},
                       {"singular_values", found.singular_values},
                       {"parameters", ordered_json::array()}};
  for (std::size_t j = 0; j < found.profiles.size(); ++j) {
    const Identification::Interval in = found.interval(found.profiles[j]);
    json["parameters"].push_back({{"name", found.profiles[j].parameter},
                                  {"value", found.fit.parameters[j].value},
                                  {"low", in.low},
                                  {"high", in.high},
                                  {"open", {in.open_low, in.open_high}}});
  }
  return json;
}

}  // namespace

void write_csv(const StudyResults& results, const std::filesystem::path& folder) {
  for (const auto* runs : {&results.reproduction, &results.variants})
    for (const RunResult& run : *runs)
      write_whole_file(folder / file_name(run.spec.name), run_csv(run));
  for (const ObstacleRun& run : results.obstacle)
    write_whole_file(folder / file_name(run.spec.name), obstacle_csv(run));
}

std::string study_json(const StudyResults& results, const std::string& report_path) {
  ordered_json root = {{"schema", kJsonSchema}};
  root["runs"] = ordered_json::object();
  for (const RunResult& run : results.reproduction)
    root["runs"][run.spec.name] = reproduction_json(run);
  for (const Ensemble& ensemble : results.ensembles)
    root["runs"][ensemble.name]["ensemble"] = ensemble_json(ensemble);
  root["variants"] = list_of(results.variants, variant_json);
  root["findings"] = list_of(results.findings, finding_json);
  root["obstacle"] = list_of(results.obstacle, obstacle_json);
  root["recordings"] = list_of(results.recordings, recording_json);
  root["search"] = list_of(results.search_rates,
                           [&](double rate) { return search_json(results.calibration, rate); });
  root["left_open"] = ordered_json::array();
  for (const Identification& found : results.identifications)
    if (found.row != "E4-text") root["left_open"].push_back(identification_json(found));
  root["evidence"] = list_of(results.evidence, evidence_json);
  root["answer"] = results.answer;
  root["optimiser"] = results.calibration.optimiser;
  root["calibration_seed"] = results.calibration.seed;
  root["arm2_mass_scale"] = results.arm2_mass_scale;
  root["hand"] = results.operator_description;
  root["command"] = results.command;
  root["seconds"] = results.seconds;
  root["report"] = report_path;
  return root.dump(1, ' ', false, ordered_json::error_handler_t::replace);
}

std::string answer_json(const Identification& found) {
  ordered_json json = {{"schema", kJsonSchema}};
  json.update(identification_json(found));
  json["evaluations"] = found.fit.evaluations;
  json["threshold"] = found.threshold();
  json["directions"] = found.directions;
  for (std::size_t j = 0; j < found.profiles.size(); ++j) {
    ordered_json& points = json["parameters"][j]["profile"];
    for (const ProfilePoint& p : found.profiles[j].points)
      points.push_back(
          {{"value", p.value}, {"misfit", p.misfit}, {"other_max_deg", p.other_max_deg}});
  }
  return json.dump(1);
}

}  // namespace twinarm
