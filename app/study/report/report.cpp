#include "app/study/report/report.h"

#include <fmt/args.h>

#include "app/data/html_page.h"
#include "app/study/report/report_slots.h"
#include "solver/support/input_file.h"

namespace twinarm {
namespace {

// Claims that hold, or those that do not, with a row above each section.
std::string claims_table(const std::vector<Finding>& all, bool holds) {
  std::string rows, last;
  for (const Finding& finding : all) {
    if (finding.holds != holds) continue;
    std::string section = finding.section;
    section[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(section[0])));
    if (section != last) rows += "<tr><th colspan=2>" + escaped(section) + "</th></tr>\n";
    last = section;
    rows += fmt::format("<tr><td>{}</td><td class=text>{}</td></tr>\n", typeset(finding.claim),
                        typeset(finding.measured));
  }
  return "<table class=claims><thead><tr><th>claim</th><th "
         "class=text>measured</th></tr></thead><tbody>\n" +
         rows + "</tbody></table>\n";
}

void add_findings(const StudyResults& results, Slots& slots) {
  slots["headline"] = typeset(results.answer.at(0));
  for (std::size_t i = 1; i < results.answer.size(); ++i) {
    const std::string& text = results.answer[i];
    const std::size_t end = std::min(text.find(". "), text.size() - 1);  // of the conclusion
    slots["answer"] += fmt::format("<details><summary>{}</summary><p>{}</p></details>\n",
                                   typeset(text.substr(0, end + 1)), typeset(text.substr(end + 1)));
  }
  const std::vector<Finding>& all = results.findings;
  slots["claims"] = fmt::format("{}", all.size());
  slots["holding"] = fmt::format("{}", std::ranges::count(all, true, &Finding::holds));
  slots["refuted"] = claims_table(all, false);
  slots["confirmed"] = claims_table(all, true);
}

// By file name, with underscores instead of hyphens.
void add_images(const std::filesystem::path& folder, Slots& slots) {
  for (const char* part : {"figures", "pictures"})
    for (const auto& entry : std::filesystem::directory_iterator(folder / part)) {
      std::string name = entry.path().stem().string();
      std::replace(name.begin(), name.end(), '-', '_');
      const std::string content = read_whole_file(entry.path());
      slots[name] =
          entry.path().extension() == ".svg"
              ? "<div class=scroll tabindex=0>" + inline_svg(content) + "</div>"
              : fmt::format("<img alt=\"Picture: see below\" src=\"data:image/png;base64,{}\">",
                            base64_of(content));
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
  page.title = "Linear or torsional springs? A study repeated";
  page.header = text.substr(0, main);
  page.main = main == std::string::npos ? "" : text.substr(main);
  page.footer = made_by(results.command, results.seconds) +
                " Every number on this page was computed in that run, except where it says "
                "published or calibrated.";
  write_whole_file(folder / "report.html", page.html());
}

}  // namespace twinarm
