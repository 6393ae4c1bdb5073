#include "app/compare/page/page.h"

#include <cctype>
#include <set>

#include "app/data/html_page.h"
#include "app/support/text.h"
#include "solver/support/input_file.h"

namespace twinarm::compare_page {
namespace {

// Additions to the style sheet of the study's report.
constexpr const char* kPageStyle = R"css(
table.index td { white-space: nowrap; }
table.index td.text { white-space: normal; min-width: 16rem; width: 100%; }
table.index td:first-child { white-space: normal; min-width: 7.5rem; }
table.index { font-size: .82rem; line-height: 1.35; }
table.index th, table.index td { padding: .2rem .45rem; }
table.index tr.group th { text-align: left; padding-top: .9rem; font-size: .92rem; }
.skipped { color: var(--soft); font-weight: 600; }
section.case { margin: 0 0 2.6rem; border-top: 1px solid var(--line); padding-top: .9rem; }
section.case h3 { margin: 0 0 .3rem; font-size: 1.16rem; }
section.case h3 .yes, section.case h3 .no { font-size: .85rem; margin-left: .6rem; }
section.case h3 .what { font-weight: 400; color: var(--soft); font-size: .92rem; margin-left: .6rem; }
section.case figure { margin: .7rem 0; }
.formula { margin: .55rem 0 .55rem 1.6rem; max-width: 76ch; font: 1.09rem/1.65 "STIX Two Text",
  "Cambria Math", Cambria, "Latin Modern Roman", "Liberation Serif", "DejaVu Serif", Georgia, serif; }
.formula sub, .formula sup { font-size: .72em; line-height: 0; }
.statement { max-width: 74ch; }
.facts { display: flex; flex-wrap: wrap; gap: .1rem 1.7rem; font-size: .9rem; margin: .5rem 0; }
.facts b { font-weight: 600; font-variant-numeric: tabular-nums; }
.facts span { color: var(--soft); }
figure svg { font: 13px "DejaVu Sans", Verdana, sans-serif; color: #000; stroke: currentColor;
  stroke-linecap: round; stroke-linejoin: round; }
.pair > .note { align-self: center; margin: 0; }
section.case p sub, section.case p sup { line-height: 0; font-size: .72em; }
.readings { width: auto; }
.command { margin: .6rem 0; padding: .45rem .8rem; }
details pre { font-size: .76rem; }
@media print {
  section.case { break-inside: auto; margin-bottom: 1.1rem; padding-top: .5rem; }
  section.case h3, .facts, .formula { break-after: avoid; break-inside: avoid; }
  .formula { font-size: 10.4pt; line-height: 1.5; }
  table.index { font-size: 6.8pt; }
  table.index th, table.index td { padding: .1rem .22rem; }
  table.index td.text, table.index td:first-child { min-width: 0; }
  figcaption, .note { font-size: 8pt; margin-top: .1rem; }
  section.case p { margin: .3rem 0; }
  section.case h3 { font-size: 11pt; }
  .facts, .readings { font-size: 8.4pt; }
  .command { padding: .25rem .6rem; }
  .pair { gap: 0 10px; break-inside: avoid; }
  section.case figure { margin: .3rem 0; }
  section.case figure.wide svg { width: 86%; }
  .pair svg { width: 92%; }
  .readings { break-inside: avoid; }
  details { display: none; }
  details[open] { display: block; }
  a { color: inherit; text-decoration: none; }
}
)css";

// "free-body" as a heading: "Free body".
std::string group_title(std::string group) {
  for (char& c : group)
    if (c == '-') c = ' ';
  if (!group.empty()) group[0] = static_cast<char>(std::toupper(group[0]));
  return escaped(group);
}

// All digits in an attribute.
std::string cell(const std::optional<double>& value, const char* format) {
  if (!value) return "<td>–</td>";
  return fmt::format("<td data-value=\"{:.17g}\">{}</td>", *value,
                     with_powers(fmt::format(fmt::runtime(format), *value)));
}

std::string index_row(const CompareRow& row) {
  const AnalyticCase& c = *row.test;
  return fmt::format(
             "<tr data-case=\"{0}\"><td><a href=\"#{0}\">{0}</a></td><td class=text>{1}</td>",
             escaped(c.name), in_unicode(c.reference)) +
         cell(row.result.error, "{:.3g}") + cell(c.tolerance, "{:.3g}") + "<td>" +
         yes_no(passes(c, row.result), "pass", "fail") + "</td>" +
         cell(row.result.order, "{:.2f}") + cell(row.result.energy_drift, "{:.1e}") +
         cell(row.seconds, "{:.2f}") + "</tr>\n";
}

std::string group_row(const std::string& group) {
  return fmt::format("<tr class=group><th colspan=8 scope=rowgroup>{}</th></tr>\n",
                     group_title(group));
}

std::string index_table(const std::vector<CompareRow>& rows,
                        const std::vector<const SkippedCase*>& skipped) {
  std::string html =
      "<table class=index><thead><tr><th>case</th><th class=text>what is checked [unit of error "
      "and tolerance]</th><th>error</th><th>tolerance</th><th></th><th>order</th><th>energy "
      "drift</th><th>time [s]</th></tr></thead><tbody>\n";
  std::string group;
  for (const CompareRow& row : rows) {
    if (group != row.test->group) html += group_row(group = row.test->group);
    html += index_row(row);
  }
  if (!skipped.empty()) html += group_row("skipped");
  for (const SkippedCase* c : skipped)
    html += fmt::format(
        "<tr data-skipped=\"{0}\"><td>{0}</td><td class=text>{1}: {2}</td><td>–</td><td>–</td>"
        "<td><span class=skipped>skipped</span></td><td>–</td><td>–</td><td>–</td></tr>\n",
        escaped(c->name), escaped(c->group), escaped(c->why));
  return html + "</tbody></table>\n";
}

constexpr const char* kHowToRead =
    "<h2 id=reading>How to read this page</h2>\n"
    "<p><b>Numbers.</b> Error and tolerance are in the unit that the case names; a case passes if "
    "its error does not exceed its tolerance. Order: the power of the step to which the error is "
    "proportional, if three steps agree. Energy drift: the largest change of energy over the "
    "largest kinetic energy, if energy is conserved.</p>\n"
    "<p><b>Run and reference.</b> Lines are the run with the integrator and step of the case; "
    "circles are the reference. For timed events the event function is drawn, with a circle at "
    "each zero of the reference.</p>\n"
    "<p><b>Error against step.</b> All integrators, with steps that double. On logarithmic axes "
    "the order is the slope, printed after the name. A colour is an order, a mark is a scheme. "
    "dopri5 chooses its steps: it is drawn at their mean, for tolerances from 1e-12 to 1e-4. "
    "Implicit schemes are run with the longest steps only, because they are slow. The dashed line "
    "is the tolerance of the case. A slope can exceed the order if the error is mostly one of "
    "energy, which rk4 has at fifth order, or if the largest terms cancel. A slope has no meaning "
    "if the error is as large as the motion, or is rounding.</p>\n"
    "<p><b>The code</b> of all cases is at the end of the page, as compiled. To add a case: "
    "docs/develop/adding_a_case.md. What is measured, and how: "
    "docs/reference/verification_cases.md.</p>\n";

// Source files of the cases, each once, as targets of the links.
std::string code_of(const std::vector<CompareRow>& rows) {
  std::set<std::string> files;
  for (const CompareRow& row : rows) files.insert(place_of(row.test->name).file);
  std::string html;
  for (const EmbeddedFile& source : case_sources())
    if (files.count(std::string(source.name)))
      html += fmt::format(
          "<details><summary id=\"code-{0}\">benchmarks/analytic/{0}</summary>\n<pre>{1}</pre>"
          "</details>\n",
          source.name, escaped(std::string(source.text)));
  return html;
}

// The figure that scripts/measure/peers --picture made; empty without it.
std::string other_engines() {
  const std::filesystem::path file = find_assets() / "compare" / "work_precision.svg";
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return "";
  return "<h2 id=engines>Other engines</h2>\n<figure class=wide>" +
         inline_svg(read_whole_file(file)) +
         "<figcaption><b>Error against computing time</b> of three smooth motions, for every "
         "scheme "
         "of twinarm, MuJoCo, Bullet, DART, Simbody and ODE, with steps or tolerances from coarse "
         "to fine: further left and lower is better. Measured on the machine and the day named in "
         "the figure, not in this run, by scripts/measure/peers; settings, contacts and what each "
         "engine cannot do: docs/understand/accuracy_vs_other_engines.md.</figcaption></figure>\n";
}

}  // namespace

// A name may be composed from a prefix that ends with a hyphen. The last occurrence is the
// registration.
CasePlace place_of(const std::string& case_name) {
  for (std::string name = case_name; name.size() >= 2; name.pop_back())
    for (const EmbeddedFile& source : case_sources()) {
      if (source.text.find("\nCaseFamily ") == std::string_view::npos) continue;
      const std::size_t at = source.text.rfind("\"" + name + "\"");
      if (at == std::string_view::npos) continue;
      const auto begin = source.text.begin(), end = begin + static_cast<std::ptrdiff_t>(at);
      return {std::string(source.name), 1 + static_cast<std::size_t>(std::count(begin, end, '\n'))};
    }
  return {};
}

std::string in_unicode(std::string words) {
  constexpr std::pair<const char*, const char*> kSigns[] = {
      {"^2", "²"},  {"m2", "m²"},   {"s2", "s²"},  {"J2", "J²"},   {"w2", "ω₂"},
      {"w3", "ω₃"}, {"alpha", "α"}, {"beta", "β"}, {" mu ", " μ "}};
  for (const auto& [plain, sign] : kSigns) words = replace_all(std::move(words), plain, sign);
  return escaped(words);
}

std::filesystem::path page_file(const std::filesystem::path& asked) {
  return asked.extension() == ".html" ? asked : asked / "compare.html";
}

std::string page_html(const std::vector<CompareRow>& rows, const std::vector<std::string>& sections,
                      const std::vector<const SkippedCase*>& skipped, const std::string& command,
                      double seconds) {
  HtmlPage page;
  page.title = "Analytic test cases of twinarm";
  page.style = kPageStyle;
  page.header =
      "<h1>Errors of the solver in analytic test cases</h1>\n<p class=lead>Motions, impacts and "
      "states with a known result, from a closed form or an independent computation: " +
      totals(rows, skipped.size()) + ".</p>\n";
  page.contents = {{"index", "Index"}, {"reading", "How to read this page"}};
  page.main = "<h2 id=index>Index</h2>\n<div class=scroll tabindex=0>" +
              index_table(rows, skipped) + "</div>\n" + kHowToRead;
  std::string group;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (group != rows[i].test->group) {
      group = rows[i].test->group;
      page.contents.emplace_back("group-" + escaped(group), group_title(group));
      page.main += fmt::format("<h2 id=\"group-{}\">{}</h2>\n", escaped(group), group_title(group));
    }
    page.main += sections[i];
  }
  if (const std::string engines = other_engines(); !engines.empty()) {
    page.contents.emplace_back("engines", "Other engines");
    page.main += engines;
  }
  page.contents.emplace_back("code", "Code");
  page.main += "<h2 id=code>Code</h2>\n" + code_of(rows);
  page.footer = made_by(command, seconds) +
                " Every number on this page was computed in that run, but for the other engines.";
  return page.html();
}

}  // namespace twinarm::compare_page
