#include "app/study/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/data/html_page.h"
#include "app/study/report/report_sections.h"
#include "app/support/output_file.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

// What the paper's question is, from its own table.
std::string introduction() {
  const PaperRow &e3 = paper_table().at("E3"), &e4 = paper_table().at("E4");
  return fmt::format(
      "<p class=lead>A hand moves a kinematic robot (KVR). Spring-dampers pull a simulated robot "
      "(DVR) after it. The paper couples the two in two ways, and reports that linear springs hold "
      "the DVR {:.1f} times (joint 1) and {:.1f} times (joint 2) closer than torsional ones: "
      "{:.1f} "
      "and {:.1f} degrees at most, instead of {:.1f} and {:.1f}. It does not publish gains, "
      "masses, "
      "or the step. This page runs its four experiments again, and asks whether linear holds "
      "better, under which conditions, and why.</p>\n",
      e3.max_deg[0] / e4.max_deg[0], e3.max_deg[1] / e4.max_deg[1], e4.max_deg[0], e4.max_deg[1],
      e3.max_deg[0], e3.max_deg[1]);
}

std::string answer_section(const StudyResults& results) {
  if (results.answer.empty()) return "";
  std::string html = "<h2 id=answer>The answer</h2>\n<div class=answer><ol>\n";
  for (const std::string& sentence : results.answer) html += "<li>" + escaped(sentence) + "</li>\n";
  return html + "</ol></div>\n";
}

struct Section {
  const char* id;
  const char* name;  // in the table of contents
  std::string html;
};

std::string page(const StudyResults& results, const std::vector<Section>& sections) {
  HtmlPage page;
  page.title = "Linear or torsional? The study of the coupled S-103";
  page.header = "<h1>Linear or torsional? The coupled S-103, run again</h1>\n" + introduction();
  page.footer = "Made by <code>" + escaped(results.command) + "</code>";
  for (const auto& [id, name, html] : sections) {
    if (!html.empty()) page.contents.emplace_back(id, name);
    page.main += html;
  }
  if (results.seconds > 0) page.footer += fmt::format(" in {:.0f} s", results.seconds);
  page.footer +=
      ". Every number on this page was computed in that run, except where it says "
      "published or calibrated.";
  return page.html();
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

std::string Gallery::figure(const std::string& name, const std::string& caption) const {
  for (const auto& file : {folder_ / "figures" / (name + ".svg"), folder_ / (name + ".svg")}) {
    if (!std::filesystem::exists(file)) continue;
    const std::string svg = read_whole_file(file);
    if (svg.find("<svg") != std::string::npos) return html_figure(svg, caption);
  }
  return "";
}

std::string Gallery::picture(const std::string& name, const std::string& caption) const {
  const auto file = folder_ / "pictures" / (name + ".png");
  if (!std::filesystem::exists(file)) return "";
  return html_figure(fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", escaped(name),
                                 base64_of(read_whole_file(file))),
                     caption);
}

std::vector<std::string> Gallery::pictures() const {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& file : std::filesystem::directory_iterator(folder_ / "pictures", error))
    if (file.path().extension() == ".png") names.push_back(file.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

void write_report(const StudyResults& results, const std::filesystem::path& folder) {
  const Gallery gallery(folder);
  const std::vector<Section> sections{
      {"answer", "Answer", answer_section(results)},
      {"table2", "Table 2", table_2_section(results)},
      {"angles", "Figures 6 and 7", angles_section(results, gallery)},
      {"scene", "Pictures", pictures_section(gallery)},
      {"why", "Why", findings_section(results, gallery)},
      {"rates", "Update rates", rates_section(results, gallery)},
      {"variants", "Variants", variants_section(results, gallery)},
      {"obstacle", "Obstacle", obstacle_section(results, gallery)},
      {"recordings", "Recordings", recordings_section(results)},
      {"search", "Search", search_section(results, gallery)},
      {"open", "What stays open", identification_section(results, gallery)},
      {"parameters", "Parameters", parameters_section(results)}};
  write_whole_file(folder / "report.html", page(results, sections));
}

}  // namespace twinarm
