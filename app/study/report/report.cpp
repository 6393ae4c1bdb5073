#include "app/study/report/report.h"

#include <fmt/args.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/data/html_page.h"
#include "app/study/findings/findings.h"
#include "app/study/findings/variants.h"
#include "app/study/report/report_slots.h"
#include "app/support/files.h"
#include "solver/support/atomic_file.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

void add_findings(const StudyResults& results, Slots& slots) {
  for (const std::string& sentence : results.answer)
    slots["answer"] += "<li>" + escaped(sentence) + "</li>\n";
  const std::vector<Finding>& all = results.findings;
  slots["claims"] = fmt::format("{}", all.size());
  slots["holding"] = fmt::format(
      "{}", std::count_if(all.begin(), all.end(), [](const Finding& f) { return f.holds; }));
  std::vector<std::pair<std::string, std::string>> rows;  // by section, in order of appearance
  for (const Finding& finding : all) {
    auto section = std::find_if(rows.begin(), rows.end(),
                                [&](const auto& some) { return some.first == finding.section; });
    if (section == rows.end()) section = rows.insert(rows.end(), {finding.section, ""});
    section->second +=
        fmt::format("<tr><td style=\"width:58%\">{}</td><td class=text>{}</td><td>{}</td></tr>\n",
                    escaped(finding.claim), escaped(finding.measured),
                    yes_no(finding.holds, "holds", "does not hold"));
  }
  for (auto& [section, claims] : rows) {
    section[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(section[0])));
    slots["findings"] += "<h3>" + escaped(section) +
                         "</h3>\n<table class=claims><thead><tr><th>claim</th><th class=text>"
                         "measured</th><th>holds</th></tr></thead><tbody>\n" +
                         claims + "</tbody></table>\n";
  }
}

// By file name, with underscores instead of hyphens.
void add_images(const std::filesystem::path& folder, Slots& slots) {
  for (const char* part : {"figures", "pictures"})
    for (const auto& entry : std::filesystem::directory_iterator(folder / part)) {
      std::string name = entry.path().stem().string();
      std::replace(name.begin(), name.end(), '-', '_');
      const std::string content = read_whole_file(entry.path());
      slots[name] = entry.path().extension() == ".svg"
                        ? inline_svg(content)
                        : fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">",
                                      escaped(name), base64_of(content));
    }
}

std::string filled(const std::filesystem::path& file, const Slots& slots) {
  fmt::dynamic_format_arg_store<fmt::format_context> places;
  for (const auto& [name, html] : slots) places.push_back(fmt::arg(name.c_str(), html));
  try {
    return fmt::vformat(read_whole_file(file), places);
  } catch (const fmt::format_error& error) {
    throw InputError({{file.string(), 0, "", error.what(), "see the shipped file", "study.file"}});
  }
}

}  // namespace

std::string rounded(double value, int digits) {
  if (std::isnan(value)) return "–";
  if (std::isinf(value)) return "none";
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (size >= 1e7 || size < 1e-3) return fmt::format("{:.{}g}", value, digits);
  const int whole = static_cast<int>(std::floor(std::log10(size))) + 1;  // digits before the point
  return fmt::format("{:.{}f}", value, std::max(0, digits - whole));
}

std::string degrees(double value) {
  if (!std::isfinite(value)) return "–";
  if (value == 0) return "0";
  return fmt::format("{:.{}f}", value,
                     std::abs(value) >= 0.1    ? 2
                     : std::abs(value) >= 0.01 ? 3
                                               : 4);
}

std::string gains_words(double first, double second) {
  return first == second ? rounded(first) : rounded(first) + "; " + rounded(second);
}

void write_report(const StudyResults& results, const std::filesystem::path& assets,
                  const std::filesystem::path& folder) {
  Slots slots;
  add_findings(results, slots);
  add_reproduction(results, slots);
  add_other_runs(results, slots);
  add_obstacle(results, slots);
  add_search(results, slots);
  add_identification(results, slots);
  add_evidence(results, slots);
  add_images(folder, slots);
  const std::string text = filled(assets / "study" / "report.html", slots);
  const std::size_t main = text.find("<!-- main -->");
  HtmlPage page;
  page.title = "Linear or torsional? Study of the coupled S-103";
  page.header = text.substr(0, main);
  page.main = main == std::string::npos ? "" : text.substr(main);
  page.contents = {
      {"answer", "Answer"},        {"table2", "Table 2"},       {"angles", "Figures 6 and 7"},
      {"scene", "Pictures"},       {"why", "Explanation"},      {"rates", "Update rates"},
      {"variants", "Variants"},    {"obstacle", "Obstacle"},    {"recordings", "Recordings"},
      {"search", "Search"},        {"open", "Identifiability"}, {"evidence", "Evidence"},
      {"parameters", "Parameters"}};
  page.footer = made_by(results.command, results.seconds) +
                " Every number on this page was computed in that run, except where it says "
                "published or calibrated.";
  write_whole_file(folder / "report.html", page.html());
}

}  // namespace twinarm
