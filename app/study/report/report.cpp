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

using Pair = std::array<double, 2>;

double worst(const Pair& p) {
  return std::max(p[0], p[1]);
}

// Comparison of the larger of the two maxima.
const char* verdict(const Pair& linear, const Pair& torsional) {
  const double ratio = worst(torsional) / worst(linear);
  return ratio > 1.1 ? "smaller" : ratio < 0.9 ? "larger" : "about equal";
}

// Ratio of the squared natural frequencies.
double spread(const RunResult& result) {
  return std::pow(result.frequency[1] / result.frequency[0], 2);
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
  add_search(results, slots);
  add_identification(results, slots);
  add_images(folder, slots);
  const std::string text = filled(assets / "study" / "report.html", slots);
  const std::size_t main = text.find("<!-- main -->");
  HtmlPage page;
  page.title = "Linear or torsional? Study of the coupled S-103";
  page.header = text.substr(0, main);
  page.main = main == std::string::npos ? "" : text.substr(main);
  page.contents = {
      {"answer", "Answer"},     {"table2", "Table 2"},       {"angles", "Figures 6 and 7"},
      {"scene", "Pictures"},    {"why", "Explanation"},      {"rates", "Update rates"},
      {"variants", "Variants"}, {"obstacle", "Obstacle"},    {"recordings", "Recordings"},
      {"search", "Search"},     {"open", "Identifiability"}, {"parameters", "Parameters"}};
  page.footer = made_by(results.command, results.seconds) +
                " Every number on this page was computed in that run, except where it says "
                "published or calibrated.";
  write_whole_file(folder / "report.html", page.html());
}

// Answer to the paper's question. The sentences are derived from the numbers, so that they are
// correct for other settings too.
std::vector<std::string> answer_in_words(const StudyResults& results) {
  const RunResult &e3 = results.reproduction[2], &e4 = results.reproduction[3];
  const double error = std::max(worst_relative_error(e3), worst_relative_error(e4));
  const auto variant = [&](const char* name) -> const RunResult& {
    return *find_run(results.variants, name);
  };
  const auto max_deg = [&](const char* name) { return words(variant(name).max_deg); };
  const ProtocolErrors& uniform_torsional = results.rows.at("row/findings_10_14/world/60");
  const ProtocolErrors& uniform_linear = results.rows.at("row/findings_10_14/linear/60");
  const RunResult& printed = variant("trial/printed-torsional/60");
  const RunResult& torsional = variant("trial/signed-torsional/60");
  const RunResult& linear = variant("trial/printed-linear/60");
  std::size_t inside = 0, numbers = 0;  // published numbers of E1, E2 in the band of the operators
  for (const Ensemble& all : results.ensembles)
    for (const auto* row : {&all.max_deg, &all.mean_deg})
      for (const Distribution& number : *row) {
        inside += number.percentile >= 10 && number.percentile <= 90;
        ++numbers;
      }
  const Ensemble &e1 = results.ensembles.at(0), &e2 = results.ensembles.at(1);
  const auto medians = [](const std::array<Distribution, 2>& d) {
    return words({d[0].median, d[1].median});
  };
  return {
      fmt::format(
          "At one rate of {:g} Hz the published laws reproduce all eight published numbers of E3 "
          "and E4 within {:.0f} %: E3 {} deg (published 16.6/23.5), E4 {} deg (3.4/6.0).",
          e3.spec.rate, std::ceil(100 * error), words(e3.max_deg), words(e4.max_deg)),
      fmt::format("E1 and E2, with the same gains and {} synthetic operators: {} of the {} "
                  "published numbers "
                  "lie between the 10 % and the 90 % quantile; the medians of the "
                  "maxima are {} and {} deg (published {} and {}).",
                  e1.seeds, inside, numbers, medians(e1.max_deg), medians(e2.max_deg),
                  words(kPaperTable.at(e1.name).max_deg), words(kPaperTable.at(e2.name).max_deg)),
      fmt::format(
          "Are the errors of a linear coupling smaller? With one k and b for both links at 60 Hz "
          "it depends on the position of the springs: uniform arms, springs at the centres of "
          "mass: linear {} against torsional {} deg, {}; S-103, springs at the ends of the arms: "
          "{} against {} deg, {}.",
          words(uniform_linear.max_deg), words(uniform_torsional.max_deg),
          verdict(uniform_linear.max_deg, uniform_torsional.max_deg), words(linear.max_deg),
          words(torsional.max_deg), verdict(linear.max_deg, torsional.max_deg)),
      fmt::format(
          "Reason: the fastest mode limits the step, the slowest one determines the error, so with "
          "equal gains the ratio of the squared frequencies matters: {:.1f} torsional, {:.1f} "
          "linear on the S-103; it is smallest for springs at the centres of mass with stiffness "
          "proportional to mass.",
          spread(torsional), spread(linear)),
      fmt::format(
          "The published torsional damper uses an unsigned angle and cannot dissipate energy: with "
          "optimal gains at 60 Hz {} deg, mean {}; with a signed damper {} deg, mean {}.",
          words(printed.max_deg), words(printed.mean_deg), words(torsional.max_deg),
          words(torsional.mean_deg)),
      fmt::format(
          "The law is not the reason: with the full stiffness of the linear coupling the errors of "
          "a torsional one are {} deg, of the linear one {}; implicit at 1 kHz torsional {} deg, "
          "linear {} deg.",
          max_deg("matched/torsional/60"), max_deg("matched/linear/60"),
          max_deg("implicit/torsional-world/1000"), max_deg("implicit/linear/1000"))};
}

}  // namespace twinarm
