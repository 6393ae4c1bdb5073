// The report's sections on what was found: Table 2, Figures 6 and 7, pictures, findings.
#include "app/study/report/report_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace twinarm {
namespace {

constexpr double kNear = 0.15;  // of a published number

const RunResult* find(const StudyResults& results, const std::string& name) {
  for (const RunResult& run : results.reproduction)
    if (run.spec.name == name) return &run;
  return nullptr;
}

// Linear theory tells the errors behind the automatic motion; a hand follows no law.
bool has_law(const RunResult& run) {
  return run.spec.name >= std::string("E3");
}

// Two runs of Table 2 side by side: measured, by theory, published, deviation.
std::string comparison_table(const std::vector<const RunResult*>& runs) {
  std::string top = "<tr><th rowspan=2>degrees</th>", second = "<tr>", body;
  for (const RunResult* run : runs) {
    top += fmt::format("<th colspan={} class=\"first text\">{}: {}</th>", has_law(*run) ? 5 : 4,
                       run->spec.name, escaped(run->spec.title));
    second += "<th class=first>measured</th>";
    if (has_law(*run)) second += "<th>by theory</th>";
    second += "<th>published</th><th>deviation</th><th>15 %</th>";
  }
  for (std::size_t row = 0; row < 4; ++row) {
    const bool maximum = row < 2;
    const std::size_t j = row % 2;
    body += fmt::format("<tr><td>{}, joint {}</td>", maximum ? "maximum" : "mean", j + 1);
    for (const RunResult* run : runs) {
      const PaperRow& paper = paper_table().at(run->spec.name);
      const double measured = maximum ? run->max_deg[j] : run->mean_deg[j];
      const double published = maximum ? paper.max_deg[j] : paper.mean_deg[j];
      const double deviation = measured / published - 1;
      body += fmt::format("<td class=\"first big\">{:.2f}</td>", measured);
      if (has_law(*run))
        body += fmt::format("<td>{:.2f}</td>",
                            maximum ? run->motion_max_deg[j] : run->motion_mean_deg[j]);
      body += fmt::format("<td>{:.1f}{}</td>", published,
                          run->spec.name == "E4" && row == 1 ? " *" : "");
      body += !run->stable || !std::isfinite(deviation)
                  ? "<td>–</td><td class=no>unstable</td>"
                  : fmt::format("<td>{}{:.1f} %</td><td>{}</td>", deviation < 0 ? "−" : "+",
                                std::abs(100 * deviation),
                                yes_no(std::abs(deviation) <= kNear, "within", "outside"));
    }
    body += "</tr>\n";
  }
  return "<div class=scroll><table class=dense><thead>" + top + "</tr>\n" + second +
         "</tr></thead>\n<tbody>" + body + "</tbody></table></div>\n";
}

std::vector<const RunResult*> present(const StudyResults& results, const char* a, const char* b) {
  std::vector<const RunResult*> runs;
  for (const char* name : {a, b})
    if (const RunResult* run = find(results, name)) runs.push_back(run);
  return runs;
}

struct Reading {               // of one joint of a run
  double largest = 0, at = 0;  // [deg], [s]
  double since_jump = 0;       // [s]; the automatic motion's speed jumps at every full second
  double at_end = 0;           // largest error in the last fifths of the sweeps [deg]
  double below_one = 0;        // share of the samples with less than 1 degree
  double lag = 0;              // mean error against the sense of motion [deg]
};

Reading read_joint(const RunResult& run, std::size_t j) {
  Reading reading;
  const TrackingSeries& series = run.series;
  if (series.q_K.size() <= j || series.q_D.size() <= j || series.t.empty()) return reading;
  const std::vector<double>&q_K = series.q_K[j], &q_D = series.q_D[j];
  const std::size_t samples = std::min(q_K.size(), q_D.size());
  double lag = 0, below = 0;
  for (std::size_t n = 0; n < samples; ++n) {
    const double error = (q_K[n] - q_D[n]) / kDegree;
    if (std::abs(error) > reading.largest) {
      reading.largest = std::abs(error);
      reading.at = series.t[n];
    }
    if (std::abs(error) < 1) ++below;
    if (series.t[n] - std::floor(series.t[n]) >= 0.8)
      reading.at_end = std::max(reading.at_end, std::abs(error));
    if (n > 0 && q_K[n] != q_K[n - 1]) lag += std::copysign(1.0, q_K[n] - q_K[n - 1]) * error;
  }
  reading.since_jump = reading.at - std::floor(reading.at + 1e-9);
  if (reading.at > 0 && reading.since_jump < 1e-9) reading.since_jump = 1;
  reading.below_one = below / static_cast<double>(samples);
  reading.lag = lag / static_cast<double>(samples);
  return reading;
}

std::string angle_caption(const char* figure, const RunResult& run) {
  const Reading one = read_joint(run, 0), two = read_joint(run, 1);
  const std::string head =
      fmt::format("<b>Figure {}. {}, {}.</b> ", figure, run.spec.name, escaped(run.spec.title));
  if (!run.stable) return head + "The run left all bounds: these gains do not hold the DVR.";
  if (run.spec.name < std::string("E3"))
    return head + fmt::format(
                      "The DVR is off by {:.1f}° and {:.1f}° at most, {:.1f}° and {:.1f}° on "
                      "average, and within 1° for {:.0f} % and {:.0f} % of the time. The hand is "
                      "synthetic: look at the kind of error, not at its moments.",
                      run.max_deg[0], run.max_deg[1], run.mean_deg[0], run.mean_deg[1],
                      100 * one.below_one, 100 * two.below_one);
  return head +
         fmt::format(
             "Largest errors: {:.1f}° of joint 1, {:.0f} ms after the last jump of the hand's "
             "speed, "
             "and {:.1f}° of joint 2, {:.0f} ms after it. In the last 0.2 s of the sweeps, when a "
             "damped error has died out, it still reaches {:.2f}° and {:.2f}°. Along the motion "
             "the "
             "DVR trails by {:.2f}° and {:.2f}° on average.",
             one.largest, 1e3 * one.since_jump, two.largest, 1e3 * two.since_jump, one.at_end,
             two.at_end, one.lag, two.lag);
}

}  // namespace

std::string table_2_section(const StudyResults& results) {
  const auto calibrated = present(results, "E3", "E4"), predicted = present(results, "E1", "E2");
  if (calibrated.empty() && predicted.empty()) return "";
  std::string html = "<h2 id=table2>Table 2: measured beside published</h2>\n";
  html += "<p>|KVR − DVR| per joint, its maximum and its mean over the run.</p>\n";
  if (!calibrated.empty()) {
    html += "<h3>Automatic motion <span class=tag>calibrated on these rows</span></h3>\n" +
            comparison_table(calibrated);
    html +=
        "<p class=note>The paper's gains are not published. Ours were searched so that these "
        "numbers come out (section Search): the agreement shows that the printed equations can "
        "give them, not that these are the paper's gains. <i>By theory</i>: the error behind the "
        "three sweeps by the linear equation of the coupling about the start pose, with these "
        "gains. "
        "The torsional damper as printed has no linear part, so its theory is undamped; that of E4 "
        "leaves out the step and the change of pose.</p>\n";
  }
  if (const RunResult* e4 = find(results, "E4"))
    html += fmt::format(
        "<p class=note>* The paper contradicts itself here: 6.0 in its table, 4.0 in its text, "
        "which "
        "is also the number of E2. We compare with the table; against the text the deviation is "
        "{:+.0f} %.</p>\n",
        100 * (e4->max_deg[1] / 4.0 - 1));
  if (!predicted.empty()) {
    html +=
        "<h3>By user <span class=\"tag prediction\">prediction: not the paper's "
        "hand</span></h3>\n" +
        comparison_table(predicted);
    html += "<p class=note>The same gains, with nothing adjusted";
    if (!results.hand_description.empty())
      html += ", moved by: " + escaped(results.hand_description);
    html +=
        ". The paper's hand was not recorded, so a deviation here measures the difference "
        "between the hands as well.</p>\n";
  }
  return html;
}

std::string angles_section(const StudyResults& results, const Gallery& gallery) {
  std::string html;
  const std::pair<const char*, const char*> figures[] = {
      {"E1", "6a"}, {"E2", "6b"}, {"E3", "7c"}, {"E4", "7d"}};
  for (const auto& [run, number] : figures)
    if (const RunResult* result = find(results, run))
      html += gallery.figure(std::string("fig") + number, angle_caption(number, *result));
  const RunResult *e3 = find(results, "E3"), *e4 = find(results, "E4");
  if (e3 && e4)
    html += gallery.figure(
        "errors",
        fmt::format(
            "<b>Errors of E3 and E4 on one axis.</b> Dashed: the reversals; dotted: the peak "
            "after one, by linear theory. The torsional "
            "error averages {:.1f}° and {:.1f}°, the linear one {:.2f}° and {:.2f}°: {:.0f} "
            "and {:.0f} times less.",
            e3->mean_deg[0], e3->mean_deg[1], e4->mean_deg[0], e4->mean_deg[1],
            e3->mean_deg[0] / e4->mean_deg[0], e3->mean_deg[1] / e4->mean_deg[1]));
  return html.empty() ? "" : "<h2 id=angles>Figures 6 and 7: both robots over time</h2>\n" + html;
}

std::string picture_caption(const std::string& name) {
  const std::pair<const char*, const char*> known[] = {
      {"robot",
       "<b>The robot.</b> S-103, three joints about vertical axes and a gripper in two "
       "positions."},
      {"E3",
       "<b>E3, torsional</b>, at its largest error. Solid: the DVR. Pale: the KVR, which it "
       "should cover."},
      {"E4", "<b>E4, linear</b>, at its largest error, seen from the same place."},
      {"obstacle-linear",
       "<b>Linear coupling</b>, while the box stops the DVR and the KVR has gone "
       "on."},
      {"obstacle-torsional", "<b>Torsional coupling</b>, at the same moment."}};
  for (const auto& [key, caption] : known)
    if (name == key) return caption;
  return escaped(name);
}

std::string pictures_section(const Gallery& gallery) {
  std::string html = gallery.picture("robot", picture_caption("robot")), pair;
  for (const std::string& name : gallery.pictures())
    if (name != "robot" && !name.starts_with("obstacle"))
      pair += gallery.picture(name, picture_caption(name));
  if (!pair.empty()) html += "<div class=pair>" + pair + "</div>\n";
  return html.empty() ? "" : "<h2 id=scene>The scene</h2>\n" + html;
}

std::string findings_section(const StudyResults& results, const Gallery& gallery) {
  if (results.findings.empty()) return "";
  const auto holding = std::count_if(results.findings.begin(), results.findings.end(),
                                     [](const Finding& finding) { return finding.holds; });
  std::string html = fmt::format(
      "<h2 id=why>What explains it</h2>\n<p>Claims about the paper's numbers that were made before "
      "this run, each derived again in it. {} of {} hold; those that do not are refuted, and stay "
      "in "
      "the list.</p>\n",
      holding, results.findings.size());
  std::vector<std::string> order;  // of first appearance
  for (const Finding& finding : results.findings)
    if (std::find(order.begin(), order.end(), finding.section) == order.end())
      order.push_back(finding.section);
  for (const std::string& section : order) {
    std::string title = escaped(section);
    if (!title.empty() && title[0] >= 'a' && title[0] <= 'z')
      title[0] = static_cast<char>(title[0] - 'a' + 'A');
    html += "<h3>" + title +
            "</h3>\n<table class=claims><thead><tr><th>claim</th><th class=text>measured</th>"
            "<th>holds</th></tr></thead><tbody>\n";
    for (const Finding& finding : results.findings)
      if (finding.section == section)
        html += fmt::format(
            "<tr><td style=\"width:58%\">{}</td><td class=text>{}</td><td>{}</td></tr>\n",
            escaped(finding.claim), escaped(finding.measured),
            yes_no(finding.holds, "holds", "does not"));
    html += "</tbody></table>\n";
  }
  return html +
         gallery.figure("ablations",
                        "<b>One change at a time</b> to the torsional law at 60 Hz. The top "
                        "row is the law with its damper mended, at its own best gains; each "
                        "other row changes one thing and keeps those gains, but for the "
                        "last, which has gains of its own. A bar marked unstable has no size. "
                        "Diamonds: the peak after a reversal by linear theory.");
}

}  // namespace twinarm
