#include "app/study/findings/findings.h"

#include <fmt/format.h>

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
  return run(robot, AutomaticMotion(OperatorMapping{}), spec);
}

std::string run_words(const std::string& name) {
  static const std::map<std::string, const char*> words{
      {"E3", "torsional, as published"},
      {"E4", "linear, as published"},
      {"findings_set0", "5/3 kg, 0.40/0.30 m"},
      {"findings_set1", "1/1 kg, 0.50/0.50 m"},
      {"findings_set2", "10/6 kg, 0.35/0.25 m"},
      {"findings_10_14", "5/3 kg, arms 10 : 14"},
      {"signed-torsional", "torsional, signed damper"},
      {"signed-torsional-ratio", "torsional, signed damper, k2 = 0.2 k1"},
      {"torsional", "torsional"},
      {"world", "torsional, world orientation"},
      {"joint", "torsional, joint angle"},
      {"world-ratio", "torsional, world orientation, k2 = 0.2 k1"},
      {"unsigned", "torsional, unsigned damper"},
      {"older", "torsional, difference one frame older"},
      {"euler", "torsional, explicit Euler"},
      {"world-", "world orientation (−)"},
      {"world+", "world orientation (+)"},
      {"joint-", "joint angle (−)"},
      {"joint+", "joint angle (+)"},
      {"explicit", "explicit"},
      {"semi-implicit", "semi-implicit"},
      {"implicit", "implicit"}};
  std::string found;
  for (const std::string& part : split(name, '/')) {
    const auto law = std::ranges::find(family_laws(), part, &FamilyLaw::name);
    const auto entry = words.find(part);
    if (law == family_laws().end() && entry == words.end()) continue;
    found += (found.empty() ? "" : ", ") +
             (entry == words.end() ? law->words : std::string(entry->second));
  }
  return found;
}

const Value& entry_of(const Value& predictions, const char* key) {
  if (const Value* value = predictions.find(key)) return *value;
  throw InputError({{"predictions.toml", predictions.line, key, "is missing",
                     "see the shipped file", "study.file"}});
}

namespace {

std::array<double, 2> pair_of(const Value& list) {
  return {list.items.at(0).number, list.items.at(1).number};
}

// Of a two-link robot, if there is one.
const Value* predicted_row(const Value& predictions, const std::string& robot,
                           const std::string& law, double rate) {
  for (const Value& row : entry_of(predictions, "row").items)
    if (entry_of(row, "robot").text == robot && entry_of(row, "law").text == law &&
        entry_of(row, "rate").number == rate)
      return &row;
  return nullptr;
}

// Why gains with smaller errors are none of a row: their errors and their stability limit.
std::string beyond_limit(const StudyInputs& inputs, const std::string& robot,
                         const RunSpec& unstable) {
  const ProtocolErrors errors =
      run_protocol(inputs.findings.at(robot), unstable, inputs.settings.sweep_times);
  return fmt::format(
      "; gains without a stability limit reach {} deg, but are stable at every pose only up to "
      "steps of {:.4g} ms, not with {:.4g} ms",
      words(errors.max_deg), 1e3 * step_limit_of_motion(inputs.findings.at(robot), unstable),
      1e3 / unstable.rate);
}

// Every searched row of the two-link robots, run again and compared with its prediction, if any.
void add_rows(const StudyInputs& inputs, const Value& predictions, StudyResults& results,
              Progress& progress) {
  std::size_t done = 0;
  for (const auto& [name, entry] : results.calibration.entries) {
    progress.advance(0.1 + 0.6 * static_cast<double>(++done) /
                               static_cast<double>(results.calibration.entries.size()));
    if (!name.starts_with("row/")) continue;
    check_interrupt();
    const std::vector<std::string> parts = split(name, '/');  // row/ROBOT/LAW/RATE
    const std::string &robot = parts[1], &law = parts[2];
    const RunSpec spec = row_spec(law, entry.rate).with_gains(entry.gains());
    const ProtocolErrors errors =
        run_protocol(inputs.findings.at(robot), spec, inputs.settings.sweep_times);
    results.rows[name] = errors;
    Finding finding{
        "update rate",
        fmt::format("{}, {}, {:g} Hz, best gains", run_words(robot), run_words(law), entry.rate),
        fmt::format("{} deg, mean {}", words(errors.max_deg), words(errors.mean_deg)), true};
    const Value* row = predicted_row(predictions, robot, law, entry.rate);
    if (!row) continue;  // no claim
    const std::array<double, 2> max_deg = pair_of(entry_of(*row, "max"));
    const Value* mean = row->find("mean");
    for (std::size_t j = 0; j < 2; ++j) {
      finding.holds &= is_near(errors.max_deg[j], max_deg[j], 0.1);
      if (mean) finding.holds &= is_near(errors.mean_deg[j], pair_of(*mean)[j], 0.1);
    }
    finding.claim += fmt::format(": predicted {} deg{} (within 10 %)", words(max_deg),
                                 mean ? ", mean " + words(pair_of(*mean)) : "");
    const double sum = errors.max_deg[0] + errors.max_deg[1];
    const double predicted_sum = max_deg[0] + max_deg[1];
    if (!finding.holds && sum < 0.98 * predicted_sum)
      finding.measured += "; better than the predicted optimum";
    else if (!finding.holds && sum < 1.03 * predicted_sum)
      finding.measured += "; another optimum with the same sum of the maxima (within 3 %)";
    else if (const auto gains = entry.unstable_gains(); !finding.holds && gains)
      finding.measured += beyond_limit(inputs, robot, spec.with_gains(*gains));
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
           fmt::format("{}, {:g} Hz: with equal gains the best linear coupling at the centres of "
                       "mass has smaller errors than the best torsional one in both joints",
                       run_words(robot), rate),
           fmt::format("linear {}, torsional {} deg: factors {:.1f} and {:.1f}", words(linear),
                       words(torsional), torsional[0] / linear[0], torsional[1] / linear[1]),
           torsional[0] > linear[0] && torsional[1] > linear[1]});
    }
}

// For each robot and rate: which coupling has the smaller errors, in the run and by linear theory.
void add_orders(const StudyInputs& inputs, StudyResults& results) {
  const auto add = [&](const StudyRobot& robot, const std::string& name, double rate,
                       const CalibrationEntry& linear, const CalibrationEntry& torsional,
                       const auto& spec_of, const auto& max_deg) {
    const auto peak = [&](const CalibrationEntry& entry) {
      return reversal_peak_of_motion(robot, spec_of(entry).with_gains(entry.gains()));
    };
    CouplingOrder order{name,         rate,           max_deg(linear), max_deg(torsional),
                        peak(linear), peak(torsional)};
    results.findings.push_back(
        {"order of the couplings",
         fmt::format("{}, {:g} Hz, best gains: linear theory (peak after a reversal, in the worst "
                     "pose of the motion; sum of both joints) predicts which coupling has the "
                     "smaller errors: linear {:.3g}, torsional {:.3g} deg",
                     name, rate, order.linear_peak_deg, order.torsional_peak_deg),
         fmt::format("linear {}, torsional {} deg", words(order.linear_deg),
                     words(order.torsional_deg)),
         order.is_predicted()});
    results.orders.push_back(order);
  };
  const Calibration& c = results.calibration;
  const StudyRobot s103 = StudyRobot::s103(inputs.settings, inputs.s103,
                                           c.entry("chosen").numbers.at("arm2_mass_scale"));
  for (double rate : inputs.settings.rates_hz) {
    const auto entry = [&](const std::string& law) -> const CalibrationEntry& {
      return c.entry(fmt::format("{}/{:g}", law, rate));
    };
    add(
        s103, "S-103", rate, entry("trial/printed-linear"), entry("trial/signed-torsional"),
        [](const CalibrationEntry& e) { return trial_spec(split(e.name, '/')[1], e.rate); },
        [&](const CalibrationEntry& e) { return find_run(results.variants, e.name)->max_deg; });
    for (const std::string robot : kTwoLinkRobots)
      add(
          inputs.findings.at(robot), run_words(robot), rate, entry("row/" + robot + "/linear"),
          entry("row/" + robot + "/world"),
          [](const CalibrationEntry& e) { return row_spec(split(e.name, '/')[2], e.rate); },
          [&](const CalibrationEntry& e) { return results.rows.at(e.name).max_deg; });
  }
}

void add_reproduction(const StudyResults& results, std::vector<Finding>& findings) {
  for (const char* name : {"E3", "E4"}) {
    const RunResult* result = find_run(results.reproduction, name);
    const double worst = worst_relative_error(*result);
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
  const Value predictions = read_toml(inputs.settings.assets / "study" / "predictions.toml");
  std::vector<Finding>& findings = results.findings;
  add_reproduction(results, findings);
  add_equal_gains(inputs, predictions, findings);
  add_rows(inputs, predictions, results, progress);
  add_ratios(inputs, results, findings);
  add_orders(inputs, results);
  add_damping(inputs, findings);
  add_differences(inputs, results, findings);
  add_stability(inputs, findings);
  add_matched_gains(results, findings);
}

}  // namespace twinarm
