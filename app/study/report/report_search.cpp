// Slots of the report on where its numbers come from: the search, and all parameters.
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>

#include "app/study/report/report_slots.h"
#include "app/support/version.h"

namespace twinarm {
namespace {

double number_or(const CalibrationEntry& entry, const char* name, double otherwise) {
  const auto found = entry.numbers.find(name);
  return found == entry.numbers.end() ? otherwise : found->second;
}

// Worst relative error, and behind it the worst when a gain moves by half a percent.
std::string error_cell(const CalibrationEntry* entry) {
  if (!entry) return "<td>–</td>";
  const double nominal = number_or(*entry, "worst_error", entry->objective);
  const double shifted = number_or(*entry, "worst_error_shifted", entry->objective);
  const std::string numbers = fmt::format("{:.1f} ({:.1f})", 100 * nominal, 100 * shifted);
  return std::max(nominal, shifted) <= 0.15 ? "<td><span class=yes>" + numbers + "</span></td>"
                                            : "<td>" + numbers + "</td>";
}

std::string parameter_row(const CalibrationEntry& entry, double scale) {
  std::string html =
      fmt::format("<tr><td>{}</td><td>{:g}</td><td>{}</td><td>{}</td>", escaped(entry.name),
                  entry.rate, rounded(scale * entry.objective), entry.evaluations);
  html += "<td class=text>";
  for (const Parameter& p : entry.parameters) {
    const bool at_bound = p.value <= 1.01 * p.low || p.value >= 0.99 * p.high;
    html += fmt::format("<span class=value>{} = {}{} <span class=small>[{:g}, {:g}]</span></span> ",
                        escaped(p.name), rounded(p.value, 5),
                        at_bound ? " <span class=no>at bound</span>" : "", p.low, p.high);
  }
  return html + "</td></tr>\n";
}

// The objective of a fit is a relative error, shown in percent; that of a trial is in degrees.
std::string parameter_table(const std::vector<const CalibrationEntry*>& entries, bool fit) {
  std::string rows;
  for (const CalibrationEntry* entry : entries) rows += parameter_row(*entry, fit ? 100 : 1);
  return fmt::format(
             "<div class=scroll><table class=dense><thead><tr><th>entry</th><th>rate<br>Hz</th>"
             "<th>objective<br>{}</th><th>evaluations</th><th class=text>parameters "
             "[bounds]</th></tr></thead><tbody>\n",
             fit ? "%" : "degrees") +
         rows + "</tbody></table></div>\n";
}

// The entries whose names begin so, by rate.
std::vector<const CalibrationEntry*> entries_of(const Calibration& calibration,
                                                const std::string& prefix) {
  std::vector<const CalibrationEntry*> entries;
  for (const auto& [name, entry] : calibration.entries)
    if (name.starts_with(prefix)) entries.push_back(&entry);
  std::stable_sort(entries.begin(), entries.end(),
                   [](const auto* a, const auto* b) { return a->rate < b->rate; });
  return entries;
}

std::string versions() {
#if defined(__clang__)
  const std::string compiler = fmt::format("clang {}", __clang_version__);
#else
  const std::string compiler = fmt::format("g++ {}", __VERSION__);
#endif
  return fmt::format("twinarm {}, {}, Eigen {}.{}.{}, fmt {}.{}.{}", kProgramVersion, compiler,
                     EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION,
                     FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100);
}

}  // namespace

void add_search(const StudyResults& results, Slots& slots) {
  const Calibration& c = results.calibration;
  const double rate = c.entry("chosen").rate;
  for (const SearchRow& row : results.search) {
    const bool chosen = row.rate == rate;
    std::string& html = slots["search_rows"];
    html += fmt::format("<tr{}><td>{:g} Hz{}</td>", chosen ? " class=chosen" : "", row.rate,
                        chosen ? ", chosen" : "");
    for (const std::string& law : e3_laws()) html += error_cell(row.e3.at(law));
    html += error_cell(row.e4) + "</tr>\n";
  }
  std::vector<const CalibrationEntry*> used = entries_of(c, fmt::format("E3/{:g}/", rate));
  used.push_back(&c.entry(fmt::format("E4/{:g}", rate)));
  slots["chosen_rate"] = fmt::format("{:g}", rate);
  slots["chosen_parameters"] = parameter_table(used, true);
  slots["parameters_trial"] = parameter_table(entries_of(c, "trial/"), false);
  slots["parameters_E3"] = parameter_table(entries_of(c, "E3/"), true);
  slots["parameters_E4"] = parameter_table(entries_of(c, "E4/"), true);
  slots["parameters_row"] = parameter_table(entries_of(c, "row/"), false);
  long evaluations = 0;
  for (const auto& [name, entry] : c.entries) evaluations += entry.evaluations;
  slots["evaluations"] = fmt::format("{}", evaluations);
  slots["searches"] = fmt::format("{}", c.entries.size());
  slots["seed"] = fmt::format("{}", c.seed);
  slots["optimiser"] = escaped(c.optimiser);
  slots["versions"] = escaped(versions());
  slots["command"] = escaped(results.command);
  slots["seconds"] = fmt::format("{:.1f}", results.seconds);
  slots["hand"] = escaped(results.hand_description);
  slots["settings"] = escaped(results.settings_text);
  slots["arm2_mass_scale"] = rounded(results.arm2_mass_scale);
  for (const auto& [link, mass] : results.link_masses)
    slots["masses_rows"] += fmt::format(
        "<tr><td>{}</td><td>{:.4f}</td><td class=small>assumed</td></tr>\n", escaped(link), mass);
}

}  // namespace twinarm
