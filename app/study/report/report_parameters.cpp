// The report's sections on where its numbers come from: the search, and all parameters.
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>

#include "app/study/report/report_sections.h"
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
  if (rows.empty()) return "";
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

std::string search_section(const StudyResults& results, const Gallery& gallery) {
  if (results.search.empty()) return "";
  const auto chosen = results.calibration.entries.find("chosen");
  const double rate = chosen == results.calibration.entries.end() ? 0 : chosen->second.rate;
  std::string html =
      "<h2 id=search>Search for the paper's gains</h2>\n<p>For each rate, the parameters that "
      "bring "
      "the worst of the four published numbers nearest: for E3 the printed torsional law with one "
      "k "
      "and b for both links and the mass of arm 2, for E4 the printed linear law with gains per "
      "link. "
      "Worst relative error in %; in brackets the worst when any one gain moves by ±0.5 %: a fit "
      "that does not survive this is a coincidence. Green: within 15 %, the "
      "bracket too.</p>\n"
      "<p class=note>World, joint: what the torsional spring measures. (−), (+): the damping "
      "couple "
      "acts against the KVR's motion, or along it; the paper can be read both ways.</p>\n"
      "<div class=scroll><table><thead><tr><th>rate</th>";
  for (const std::string& law : e3_laws()) {
    std::string words = law;
    const bool against = law.ends_with("-");
    if (against || law.ends_with("+"))
      words = law.substr(0, law.size() - 1) + (against ? " (−)" : " (+)");
    html += "<th>E3 " + escaped(words) + "</th>";
  }
  html += "<th class=first>E4 linear</th></tr></thead><tbody>\n";
  for (const SearchRow& row : results.search) {
    html += fmt::format("<tr{}><td>{:g} Hz{}</td>", row.rate == rate ? " class=chosen" : "",
                        row.rate, row.rate == rate ? ", chosen" : "");
    for (const std::string& law : e3_laws()) {
      const auto entry = row.e3.find(law);
      html += error_cell(entry == row.e3.end() ? nullptr : entry->second);
    }
    html += error_cell(row.e4) + "</tr>\n";
  }
  html += "</tbody></table></div>\n";
  html +=
      gallery.figure("search",
                     "<b>Best fit against the rate.</b> The largest deviation of the four numbers. "
                     "Where both E3 and E4 lie low, one common rate can explain both rows.");
  if (rate <= 0) return html;
  html += fmt::format("<h3>Chosen: {:g} Hz for all four runs, mass of arm 2 times {}</h3>\n", rate,
                      rounded(results.arm2_mass_scale));
  std::vector<const CalibrationEntry*> used =
      entries_of(results.calibration, fmt::format("E3/{:g}/", rate));
  for (const CalibrationEntry* entry : entries_of(results.calibration, "E4/"))
    if (entry->rate == rate) used.push_back(entry);
  return html + parameter_table(used, true);
}

std::string parameters_section(const StudyResults& results) {
  std::string html = "<h2 id=parameters>All parameters</h2>\n<dl>\n";
  const auto item = [&](const char* term, const std::string& text) {
    if (!text.empty()) html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", term, text);
  };
  const Calibration& c = results.calibration;
  long evaluations = 0;
  for (const auto& [name, entry] : c.entries) evaluations += entry.evaluations;
  item("command", results.command.empty() ? "" : "<code>" + escaped(results.command) + "</code>");
  item("time", results.seconds > 0 ? fmt::format("{:.1f} s", results.seconds) : "");
  item("versions", escaped(versions()));
  item("hand of E1, E2", escaped(results.hand_description));
  item("optimiser", escaped(c.optimiser));
  item("its seed", c.entries.empty() ? "" : fmt::format("{}", c.seed));
  item("evaluations",
       c.entries.empty() ? "" : fmt::format("{} in {} searches", evaluations, c.entries.size()));
  html += "</dl>\n";
  if (!results.link_masses.empty()) {
    html +=
        "<h3>Masses (assumed)</h3>\n<p>The paper publishes none. Computed from our CAD meshes and "
        "assumed densities; ";
    html += fmt::format("everything outward of joint 2 is multiplied by {} in the runs.</p>\n",
                        rounded(results.arm2_mass_scale));
    html +=
        "<table style=\"max-width:26rem\"><thead><tr><th>link</th><th>mass, kg</th><th></th></tr>"
        "</thead><tbody>\n";
    for (const auto& [link, mass] : results.link_masses)
      html += fmt::format("<tr><td>{}</td><td>{:.4f}</td><td class=small>assumed</td></tr>\n",
                          escaped(link), mass);
    html += "</tbody></table>\n";
  }
  if (!results.settings_text.empty())
    html += "<h3>Settings, as used (settings.toml)</h3>\n<pre>" + escaped(results.settings_text) +
            "</pre>\n";
  const std::string trials = parameter_table(entries_of(c, "trial/"), false);
  if (!trials.empty()) html += "<h3>Gains by trial</h3>\n" + trials;
  for (const auto& [prefix, title] : {std::pair{"E3/", "All fits on E3"},
                                      {"E4/", "All fits on E4"},
                                      {"row/", "Two-link robots"}}) {
    const std::string table = parameter_table(entries_of(c, prefix), prefix[0] == 'E');
    if (!table.empty())
      html += fmt::format("<details><summary>{}</summary>\n{}</details>\n", title, table);
  }
  return html;
}

}  // namespace twinarm
