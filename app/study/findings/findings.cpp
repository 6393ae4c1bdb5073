#include "app/study/findings/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/data/value.h"
#include "app/study/findings/variants.h"
#include "app/support/progress.h"
#include "app/support/text.h"

namespace twinarm {

std::string words(const std::array<double, 2>& p) {
  return fmt::format("{:.3g}/{:.3g}", p[0], p[1]);
}

bool is_near(double measured, double predicted, double relative) {
  return std::abs(measured - predicted) <= relative * std::abs(predicted);
}

RunResult run_automatic(const StudyRobot& robot, RunSpec spec, double k, double b, double rate) {
  spec.gains = Gains::both(k, b);
  spec.rate = rate;
  return run(robot, AutomaticMotion(HandMapping{}), spec);
}

const char* robot_words(const std::string& name) {
  return name == "findings_set0" ? "5/3 kg, 0.40/0.30 m" : "5/3 kg, arms 10 : 14";
}

namespace {

std::string text_of(const Value& table, const char* key) {
  const Value* value = table.find(key);
  return value ? value->text : "";
}

std::optional<std::array<double, 2>> pair_of(const Value& table, const char* key) {
  const Value* list = table.find(key);
  if (!list || list->items.size() != 2) return {};
  return std::array<double, 2>{list->items[0].number, list->items[1].number};
}

Predictions read_predictions(const std::filesystem::path& assets) {
  const Value root = read_toml(assets / "study" / "predictions.toml");
  Predictions predictions;
  if (const Value* rows = root.find("row"))
    for (const Value& row : rows->items) {
      const Value* rate = row.find("rate");
      predictions.rows.push_back(
          {text_of(row, "robot"), text_of(row, "law"), rate ? rate->number : 0,
           pair_of(row, "max").value_or(std::array<double, 2>{}), pair_of(row, "mean")});
    }
  if (const Value* modes = root.find("modes"))
    for (const Value& table : modes->items) {
      PredictedModes& mode = predictions.modes.emplace_back();
      mode.robot = text_of(table, "robot");
      for (const char* law : {"world", "joint", "linear"})
        if (const Value* ratio = table.find(law)) mode.ratio[law] = ratio->number;
    }
  return predictions;
}

// Every searched row of the two-link robots, run again and compared with its prediction, if any.
void add_rows(const StudyInputs& inputs, const Predictions& predictions, StudyResults& results,
              Progress& progress) {
  std::size_t done = 0;
  for (const auto& [name, entry] : results.calibration.entries) {
    progress.advance(0.1 + 0.6 * static_cast<double>(++done) /
                               static_cast<double>(results.calibration.entries.size()));
    if (!name.starts_with("row/")) continue;
    check_interrupt();
    const std::vector<std::string> parts = split(name, '/');  // row/ROBOT/LAW/RATE
    const std::string &robot = parts[1], &law = parts[2];
    const double rate = entry.rate;
    const RunSpec spec = row_spec(law, rate).with_gains(entry.gains());
    const ProtocolErrors errors =
        run_protocol(inputs.findings.at(robot), spec, inputs.settings.sweep_times);
    results.rows[name] = errors;
    Finding finding{
        "update rate", fmt::format("{}, {}, {:g} Hz, best gains", robot_words(robot), law, rate),
        fmt::format("{} deg, mean {}", words(errors.max_deg), words(errors.mean_deg)), true};
    const auto row = std::find_if(
        predictions.rows.begin(), predictions.rows.end(),
        [&](const PredictedRow& p) { return p.robot == robot && p.law == law && p.rate == rate; });
    if (row == predictions.rows.end()) continue;  // no claim
    for (std::size_t j = 0; j < 2; ++j) {
      finding.holds = finding.holds && is_near(errors.max_deg[j], row->max_deg[j], 0.1);
      if (row->mean_deg)
        finding.holds = finding.holds && is_near(errors.mean_deg[j], (*row->mean_deg)[j], 0.1);
    }
    finding.claim += fmt::format(": predicted {} deg{} (within 10 %)", words(row->max_deg),
                                 row->mean_deg ? ", mean " + words(*row->mean_deg) : "");
    const double sum = errors.max_deg[0] + errors.max_deg[1];
    const double predicted_sum = row->max_deg[0] + row->max_deg[1];
    if (!finding.holds && sum < 0.98 * predicted_sum)
      finding.measured += "; better than the predicted optimum";
    else if (!finding.holds && sum < 1.03 * predicted_sum)
      finding.measured += "; another optimum with the same sum of the maxima (within 3 %)";
    results.findings.push_back(finding);
  }
}

// For each rate: linear springs at the centres of mass against torsional ones.
void add_ratios(const StudyInputs& inputs, const StudyResults& results,
                std::vector<Finding>& findings) {
  for (const char* robot : kTwoLinkRobots)
    for (double rate : inputs.settings.rates_hz) {
      const std::array<double, 2> torsional =
          results.rows.at(fmt::format("row/{}/world/{:g}", robot, rate)).max_deg;
      const std::array<double, 2> linear =
          results.rows.at(fmt::format("row/{}/linear/{:g}", robot, rate)).max_deg;
      findings.push_back(
          {"update rate",
           fmt::format(
               "{}, {:g} Hz: with equal gains the best linear coupling at the centres of mass has "
               "smaller errors than the best torsional one in both joints",
               robot_words(robot), rate),
           fmt::format("linear {}, torsional {} deg: factors {:.1f} and {:.1f}", words(linear),
                       words(torsional), torsional[0] / linear[0], torsional[1] / linear[1]),
           torsional[0] > linear[0] && torsional[1] > linear[1]});
    }
}

void add_reproduction(const StudyResults& results, std::vector<Finding>& findings) {
  for (const char* name : {"E3", "E4"}) {
    const RunResult* result = find_run(results.reproduction, name);
    const double worst = worst_relative_error(*result, paper_table().at(name));
    findings.push_back(
        {"Table 2",
         fmt::format("{}: each of the four published numbers is reproduced within 15 %", name),
         fmt::format("{} deg, mean {}; worst deviation {:.1f} %", words(result->max_deg),
                     words(result->mean_deg), 100 * worst),
         worst <= 0.15});
  }
}

}  // namespace

void derive_findings(const StudyInputs& inputs, StudyResults& results, Progress& progress) {
  const Predictions predictions = read_predictions(inputs.settings.assets);
  std::vector<Finding>& findings = results.findings;
  add_reproduction(results, findings);
  add_equal_gains(inputs, predictions, findings);
  add_rows(inputs, predictions, results, progress);
  add_ratios(inputs, results, findings);
  add_damping(inputs, findings);
  add_differences(inputs, results, findings);
  add_stability(inputs, findings);
  add_matched_gains(results, findings);
}

}  // namespace twinarm
