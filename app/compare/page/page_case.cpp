// Section of one case.

#include <regex>

#include "app/compare/page/page.h"
#include "app/data/html_page.h"
#include "app/support/text.h"

namespace twinarm::compare_page {
namespace {

// Removes from gnuplot's SVG what makes up half of a page of hundreds of figures: empty groups,
// hundredths of a pixel, and attributes that the style sheet sets for all figures (page.cpp,
// `figure svg`). Also titles and ids of plots, which are not unique in the page.
std::string figure(const std::string& drawn, const std::string& caption, const char* kind = "") {
  static const std::regex kIdle(
      R"re(<g fill="none"[^>]*>\s*</g>\s*|<title>[^<]*</title>| id="gnuplot_plot[^"]*")re"
      R"re(|<rect x="0" y="0"[^>]*>|<filter[^>]*>[\s\S]*?</filter>\s*)re"
      R"re(|<g transform[^>]*>\s*<text>\s*</text>\s*</g>| class="gridline"| font-size="13.00")re"
      R"re(| color="black" stroke="currentColor"| stroke-line(?:cap|join)="round")re"
      R"re(| font-family="[^"]*"| stroke-width="1.00"|(\.\d)\d(?=,|\)| [LM ]))re");
  if (drawn.empty()) return "";
  static const std::regex kTag(
      "<[^>]*>.*|&[a-z]*;");  // the caption's first words, in bold, are its title
  const std::string label = std::regex_replace(caption.substr(caption.find('>') + 1), kTag, "");
  return fmt::format("<figure{}>{}<figcaption>{}</figcaption></figure>\n", kind,
                     inline_svg(std::regex_replace(drawn, kIdle, "$1"), label), caption);
}

// HTML with formulas in paragraphs.
std::string integration_words(const Integration& integration) {
  if (integration.integrator == Integrator::dopri5)
    return fmt::format("dopri5, tolerance {:g}", integration.tolerance);
  return fmt::format("{}, step {:g} s", integrator_name(integration.integrator), integration.step);
}

std::string fact(const std::string& name, const std::string& value) {
  return fmt::format("<div><span>{}</span> <b>{}</b></div>", name, with_powers(value));
}

std::string facts_of_case(const CompareRow& row, const TrajectoryCase* motion) {
  const AnalyticCase& c = *row.test;
  std::string html = "<div class=facts>" + fact("error", fmt::format("{:.3g}", row.result.error)) +
                     fact("tolerance", fmt::format("{:.3g}", c.tolerance));
  if (row.result.order) html += fact("order", fmt::format("{:.2f}", *row.result.order));
  if (row.result.energy_drift)
    html += fact("energy drift", fmt::format("{:.1e}", *row.result.energy_drift));
  html += fact("time", fmt::format("{:.2f} s", row.seconds));
  if (motion && motion->has_steps())
    html += fact("integrator", integration_words(motion->integration));
  return html + "</div>\n";
}

std::string integrations_table(const CompareRow& row) {
  if (row.integrations.empty()) return "";
  std::string html =
      "<table class=readings><thead><tr><th>integrator<th>error<th>order<th>energy drift<th>time"
      "</thead><tbody>\n";
  for (const IntegrationRow& r : row.integrations)
    html += fmt::format("<tr><td>{}<td>{:.3g}<td>{}<td>{}<td>{:.2f} s\n",
                        integration_words(r.integration), r.result.error,
                        r.order ? fmt::format("{:.2f}", *r.order) : "–",
                        r.result.energy_drift ? fmt::format("{:.1e}", *r.result.energy_drift) : "–",
                        r.result.seconds);
  return with_powers(html) + "</tbody></table>\n";
}

std::string readings_table(const TrajectoryCase& c) {
  std::string html =
      "<table class=readings><thead><tr><th>reading<th>twinarm<th>exact<th>difference</thead>"
      "<tbody>\n";
  const CaseScene scene = c.scene();
  const CaseReadings seen = c.observe(scene.model, scene.start), exact = c.reference(0);
  for (std::size_t i = 0; i < c.readings.size() && i < seen.size() && i < exact.size(); ++i) {
    const double error = seen[i] - exact[i];
    html += fmt::format("<tr><td>{}<td>{:.15g}<td>{:.15g}<td>{}\n", in_unicode(c.readings[i]),
                        seen[i], exact[i] + 0.0, error == 0 ? "0" : fmt::format("{:.1e}", error));
  }
  return with_powers(html) + "</tbody></table>\n";
}

std::string numbers_table(const CaseResult& result) {
  if (result.numbers.empty()) return "";
  std::string html =
      "<table class=readings><thead><tr><th>quantity<th>published<th>twinarm<th>difference [units "
      "of the last digit]</thead><tbody>\n";
  for (const ComparedNumber& number : result.numbers)
    html += fmt::format("<tr><td>{} [{}]<td>{}<td>{:.12g}<td>{:.2g}\n", escaped(number.quantity),
                        escaped(number.unit), number.published, number.answer, number.error);
  return with_powers(html) + "</tbody></table>\n";
}

// Run and reference, errors and energy; the captions of the three.
std::string figures(const CompareRow& row, const CaseCurves& curves, std::string of_motion,
                    const std::string& of_errors, const std::string& of_energy) {
  const std::string name = row.test->name;
  Gnuplot gnuplot;
  if (curves.is_cut) of_motion += " Only the beginning is drawn.";
  std::string html = figure(motion_figure(gnuplot, name, curves), of_motion, " class=wide") +
                     "<div class=pair>" +
                     figure(error_figure(gnuplot, name, curves, row.test->tolerance), of_errors) +
                     figure(energy_figure(gnuplot, name, curves), of_energy);
  if (!curves.no_convergence.empty()) html += "<p class=note>" + curves.no_convergence + "</p>\n";
  return html + "</div>\n";
}

std::string figures_of(const CompareRow& row, const TrajectoryCase& c) {
  const CaseCurves curves = curves_of(c, row.result.error);
  std::string caption = "Run (" + integration_words(c.integration) + ") and reference.";
  if (c.events.count > 0)
    caption += " The reference gives the times of the events and the readings there.";
  return figures(row, curves, caption, "Error against step, with slopes.",
                 curves.energy_is_relative ? "Energy error of the scheme over time."
                                           : "Energy over time, including the work of forces.");
}

std::string contact_figures(const CompareRow& row) {
  const std::optional<CaseCurves> curves = contact_curves_of(*row.test);
  if (!curves) return "";
  std::string caption = curves->exact_t.empty() ? "The run." : "Run and reference.";
  if (!curves->drawn.empty())
    caption = fmt::format("{}, {}.", escaped(curves->drawn),
                          curves->exact_t.empty() ? "several runs" : "runs and reference");
  return figures(row, *curves, caption,
                 "Error of the case against the step. " + curves->convergence_note,
                 "Change of energy over time, by impacts, friction and other forces, and by the "
                 "error of the integrator.");
}

std::string command_of(const CompareRow& row, const std::vector<Integration>& integrations) {
  std::string command = std::string("twinarm compare ") + row.test->name;
  const TrajectoryCase* c = row.test->trajectory.get();
  if (c && c->takes_any_integrator() && integrations.empty() &&
      c->integration.integrator != Integrator::dopri5)
    command += fmt::format(" --integrator {},dopri5 --step {:g},{:g}",
                           integrator_name(c->integration.integrator), c->integration.step,
                           2 * c->integration.step);
  return "<pre class=command>" + escaped(command) + "</pre>\n";
}

std::string link_to_code(const std::string& case_name) {
  const CasePlace place = place_of(case_name);
  if (place.file.empty()) return "";
  return fmt::format(
      "<p class=note>Code: <a href=\"#code-{0}\">benchmarks/analytic/{0}</a>, line {1}</p>\n",
      place.file, place.line);
}

}  // namespace

std::string case_section(const CompareRow& row, const std::vector<Integration>& integrations) {
  const AnalyticCase& c = *row.test;
  const bool pass = passes(c, row.result);
  std::string html =
      fmt::format("<section class=case id=\"{0}\"><h3>{0}{1}<span class=what>{2}</span></h3>\n",
                  escaped(c.name), yes_no(pass, "pass", "fail"), in_unicode(c.reference));
  const TrajectoryCase* motion = c.trajectory.get();
  html += "<div class=statement>" + replace_all(c.statement, "<p>", "<p class=formula>") +
          "</div>\n" + facts_of_case(row, motion) + integrations_table(row) +
          numbers_table(row.result);
  if (motion) html += motion->has_steps() ? figures_of(row, *motion) : readings_table(*motion);
  if (!motion) html += contact_figures(row);
  return html + command_of(row, integrations) + link_to_code(c.name) + "</section>\n";
}

}  // namespace twinarm::compare_page
