#include "app/study/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/data/page_style.h"
#include "app/study/report/report_sections.h"
#include "app/support/output_file.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

std::string base64(const std::string& bytes) {
  constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8 | (j < count ? static_cast<unsigned char>(bytes[i + j]) : 0U);
    for (std::size_t j = 0; j < 4; ++j)
      text += j <= count ? letters[group >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

std::string framed(const std::string& content, const std::string& caption) {
  return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", content, caption);
}

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
  std::string html =
      "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8>\n"
      "<meta name=viewport content=\"width=device-width, initial-scale=1\">\n"
      "<title>Linear or torsional? The study of the coupled S-103</title>\n<style>";
  html += kReportStyle;
  html +=
      "</style></head><body>\n<header><h1>Linear or torsional? The coupled S-103, run again</h1>\n";
  html += introduction() + "</header>\n<nav aria-label=Contents><div>";
  for (const Section& section : sections)
    if (!section.html.empty())
      html += fmt::format("<a href=\"#{}\">{}</a>", section.id, section.name);
  html += "</div></nav>\n<main>\n";
  for (const Section& section : sections) html += section.html;
  html += "</main>\n<footer>Made by <code>" + escaped(results.command) + "</code>";
  if (results.seconds > 0) html += fmt::format(" in {:.0f} s", results.seconds);
  return html +
         ". Every number on this page was computed in that run, except where it says "
         "published or calibrated.</footer>\n</body></html>\n";
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
    const std::size_t begin = svg.find("<svg");  // without the XML declaration
    if (begin == std::string::npos) continue;
    return framed("<svg role=img" + svg.substr(begin + 4), caption);
  }
  return "";
}

std::string Gallery::picture(const std::string& name, const std::string& caption) const {
  const auto file = folder_ / "pictures" / (name + ".png");
  if (!std::filesystem::exists(file)) return "";
  return framed(fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", escaped(name),
                            base64(read_whole_file(file))),
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
