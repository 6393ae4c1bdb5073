// Slots of the report on the identification from Table 2, the search, and all parameters.

#include "app/study/findings/findings.h"
#include "app/study/report/report_slots.h"
#include "app/support/version.h"

namespace twinarm {
namespace {

// A combination of parameters is not identifiable if it can change by this factor without changing
// one of the four numbers by half of its last digit.
constexpr double kOpenFactor = 1.25;

// "k = 61.4 kN/m [58.1 kN/m, 70.2 kN/m]".
std::string value_words(const Parameter& p, bool linear, int digits, const std::string& range) {
  return fmt::format("<span class=value>{} = {} <span class=small>{}</span></span> ",
                     symbol_of(p.name), quantity(p.value, unit_of(p.name, linear), digits), range);
}

std::string parameter_words(const Identification& found, std::size_t j) {
  const Identification::Interval in = found.interval(found.profiles[j]);
  const Parameter& p = found.fit.parameters[j];
  const CouplingSpec& law = family_law(found.law).coupling;
  const bool linear = facts_of(law.type, law.printed).at_point;
  const std::string unit = unit_of(p.name, linear);
  return value_words(
      p, linear, 3,
      in.open_low && in.open_high
          ? "<span class=no>open</span>"
          : fmt::format("[{}{}, {}{}]", in.open_low ? "&lt; " : "", quantity(in.low, unit),
                        in.open_high ? "&gt; " : "", quantity(in.high, unit)));
}

bool is_open(double singular_value) {
  return !(singular_value * std::log(kOpenFactor) > 1);
}

bool leaves_open(const Identification& found) {
  return std::ranges::any_of(found.singular_values, is_open);
}

// Products of powers that are not identifiable, without small exponents.
std::string open_combinations(const Identification& found) {
  if (!leaves_open(found)) return "none";
  std::string words;
  for (std::size_t i = 0; i < found.singular_values.size(); ++i) {
    if (!is_open(found.singular_values[i])) continue;
    const std::vector<double>& v = found.directions[i];
    const auto largest =
        std::ranges::max_element(v, [](double a, double b) { return std::abs(a) < std::abs(b); });
    std::string product;
    for (std::size_t j = 0; j < v.size(); ++j) {
      const double power = v[j] / *largest;
      if (std::abs(power) < 0.15) continue;
      const std::string exponent =
          std::abs(power - 1) < 0.05
              ? ""
              : fmt::format("<sup>{}{:.1f}</sup>", power < 0 ? "−" : "", std::abs(power));
      product += fmt::format("{}<span class=factor>{}{}</span>", product.empty() ? "" : " ",
                             symbol_of(found.fit.parameters[j].name), exponent);
    }
    words += (words.empty() ? "" : "<br>") + product;
  }
  return words;
}

// Range over all points of the profiles below the threshold.
std::string other_motion(const Identification& found) {
  std::array<double, 2> low{HUGE_VAL, HUGE_VAL}, high{0, 0};
  for (const Profile& profile : found.profiles)
    for (const ProfilePoint& point : profile.points)
      for (std::size_t j = 0; j < 2 && point.misfit <= found.threshold(); ++j) {
        low[j] = std::min(low[j], point.other_max_deg[j]);
        high[j] = std::max(high[j], point.other_max_deg[j]);
      }
  return fmt::format("{} to {} / {} to {}", degrees(low[0]), degrees(high[0]), degrees(low[1]),
                     degrees(high[1]));
}

// The four numbers of Table 2: two cells.
std::string number_cells(const std::array<double, 2>& max_deg,
                         const std::array<double, 2>& mean_deg) {
  return fmt::format("<td>{:.2f} / {:.2f}</td><td>{:.2f} / {:.2f}</td>", max_deg[0], max_deg[1],
                     mean_deg[0], mean_deg[1]);
}

std::string law_row(const Identification& found) {
  const bool agrees = found.fit.objective <= 1;
  std::string html =
      fmt::format("<tr><td class=text>{}</td><td>{:g}</td><td><span class={}>{}</span></td>",
                  typeset(family_law(found.law).words), found.fit.rate, agrees ? "yes" : "no",
                  rounded(found.fit.objective));
  const auto number = [&](const char* name) { return found.fit.numbers.at(name); };
  html += number_cells({number("max1_deg"), number("max2_deg")},
                       {number("mean1_deg"), number("mean2_deg")});
  html += "<td class=text>";
  for (std::size_t j = 0; j < found.profiles.size(); ++j) html += parameter_words(found, j);
  html += "</td>";
  return html + fmt::format("<td class=text>{}</td><td>{}</td></tr>\n", open_combinations(found),
                            other_motion(found));
}

std::string row_table(const std::vector<Identification>& all, const std::string& row) {
  std::string rows;
  for (const FamilyLaw& law : family_laws())
    for (const Identification& found : all)
      if (found.row == row && found.law == law.name) rows += law_row(found);
  const PaperRow& paper = kPaperTable.at(row);
  const std::string published = "<tr><td class=text><b>published</b></td><td></td><td></td>" +
                                number_cells(paper.max_deg, paper.mean_deg) +
                                "<td></td><td></td><td></td></tr>\n";
  return "<h3>" + row +
         "</h3>\n<div class=scroll tabindex=0><table class=dense><thead><tr><th "
         "class=text>law</th><th>rate<br>Hz</th><th>misfit</th><th>max, degrees,<br>joints 1 / "
         "2</th><th>mean, degrees,<br>joints 1 / 2</th><th class=text>parameters and their "
         "intervals</th><th class=text>not identifiable</th><th>max at half speed,<br>degrees, "
         "joints 1 / 2</th></tr></thead><tbody>\n" +
         published + rows + "</tbody></table></div>\n";
}

// Numbers of laws that agree with each row.
std::string open_sums(const std::vector<Identification>& all) {
  std::string html;
  for (const char* row : {"E3", "E4"}) {
    int all_pairs = 0, agree = 0, open = 0;
    for (const Identification& found : all) {
      if (found.row != row) continue;
      ++all_pairs;
      if (found.fit.objective > 1) continue;
      ++agree;
      if (leaves_open(found)) ++open;
    }
    html += fmt::format(
        "<li>{}: {} of {} pairs of law and rate agree with all four printed numbers; in {} of "
        "these a combination of the parameters is not identifiable.</li>\n",
        row, agree, all_pairs, open);
  }
  return html;
}

// Worst relative error, and in brackets the worst if a gain changes by 0.5 %.
std::string error_cell(const CalibrationEntry& entry) {
  const double nominal = entry.numbers.at("worst_error");
  const double shifted = entry.numbers.at("worst_error_shifted");
  const std::string numbers = fmt::format("{:.1f} ({:.1f})", 100 * nominal, 100 * shifted);
  return std::max(nominal, shifted) <= 0.15 ? "<td><span class=yes>" + numbers + "</span></td>"
                                            : "<td>" + numbers + "</td>";
}

std::string parameter_row(const CalibrationEntry& entry, double scale) {
  std::string html = fmt::format("<tr><td>{}</td><td>{:g}</td><td>{}</td><td>{}</td>",
                                 typeset(run_words(entry.name)), entry.rate,
                                 rounded(scale * entry.objective), entry.evaluations);
  html += "<td class=text>";
  const bool linear =
      entry.name.starts_with("E4") || entry.name.find("linear") != std::string::npos;
  for (const Parameter& p : entry.parameters) {
    const std::string unit = unit_of(p.name, linear);
    html += value_words(p, linear, 5,
                        fmt::format("[{}, {}]{}", quantity(p.low, unit), quantity(p.high, unit),
                                    p.is_at_bound() ? " <span class=no>at bound</span>" : ""));
  }
  return html + "</td></tr>\n";
}

// The objective of a fit is a relative error, shown in percent; that of optimal gains is in
// degrees.
std::string parameter_table(const std::vector<const CalibrationEntry*>& entries, bool fit) {
  std::string rows;
  for (const CalibrationEntry* entry : entries) rows += parameter_row(*entry, fit ? 100 : 1);
  return fmt::format(
             "<div class=scroll tabindex=0><table "
             "class=dense><thead><tr><th>law</th><th>rate<br>Hz</th><th>objective<br>{}</"
             "th><th>evaluations</th><th class=text>parameters [bounds]</th></tr></thead><tbody>\n",
             fit ? "%" : "degrees") +
         rows + "</tbody></table></div>\n";
}

// Entries with this prefix, by rate.
std::vector<const CalibrationEntry*> entries_of(const Calibration& calibration,
                                                const std::string& prefix) {
  std::vector<const CalibrationEntry*> entries;
  for (const auto& [name, entry] : calibration.entries)
    if (name.starts_with(prefix)) entries.push_back(&entry);
  std::ranges::stable_sort(entries, {}, &CalibrationEntry::rate);
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

void add_identification(const StudyResults& results, Slots& slots) {
  const std::vector<Identification>& all = results.identifications;
  slots["open_sums"] = open_sums(all);
  for (const char* row : {"E3", "E4"}) slots[std::string("open_") + row] = row_table(all, row);
}

void add_search(const StudyResults& results, Slots& slots) {
  const Calibration& c = results.calibration;
  const double rate = c.entry("chosen").rate;
  for (const double searched : results.search_rates) {
    const bool chosen = searched == rate;
    std::string& html = slots["search_rows"];
    html += fmt::format("<tr{}><td>{:g} Hz{}</td>", chosen ? " class=chosen" : "", searched,
                        chosen ? ", chosen" : "");
    for (const std::string& law : kE3Laws) html += error_cell(c.e3(law, searched));
    html += error_cell(c.e4(searched)) + "</tr>\n";
  }
  slots["chosen_rate"] = fmt::format("{:g}", rate);
  for (const std::string group : {"trial", "E3", "E4", "row"})
    slots["parameters_" + group] = parameter_table(entries_of(c, group + "/"), group[0] == 'E');
  long evaluations = 0;
  for (const auto& [name, entry] : c.entries) evaluations += entry.evaluations;
  slots["evaluations"] = fmt::format("{}", evaluations);
  slots["searches"] = fmt::format("{}", c.entries.size());
  slots["seed"] = fmt::format("{}", c.seed);
  slots["optimiser"] = escaped(c.optimiser);
  slots["versions"] = escaped(versions());
  slots["command"] = escaped(results.command);
  slots["seconds"] = fmt::format("{:.1f}", results.seconds);
  slots["hand"] = escaped(results.operator_description);
  slots["settings"] = escaped(results.settings_text);
  slots["arm2_mass_scale"] = rounded(results.arm2_mass_scale);
  for (const auto& [link, mass] : results.link_masses)
    slots["masses_rows"] +=
        fmt::format("<tr><td>{}</td><td>{:.4f}</td></tr>\n", escaped(link), mass);
}

}  // namespace twinarm
