// The report's sections on all that was run beside E1 to E4: update rates and variants.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "app/study/report/report_sections.h"

namespace twinarm {
namespace {

// "semi-implicit/linear/60" as words: the group where it tells the treatment, not the rate.
std::string run_words(const std::string& name, bool with_group) {
  const std::size_t first = name.find('/'), last = name.rfind('/');
  if (first == std::string::npos) return name;
  const std::string law =
      last == first ? name.substr(first + 1) : name.substr(first + 1, last - first - 1);
  return with_group ? name.substr(0, first) + ", " + law : law;
}

const RunResult* find(const std::vector<RunResult>& runs, const std::string& name) {
  for (const RunResult& run : runs)
    if (run.spec.name == name) return &run;
  return nullptr;
}

std::string pair_of(const std::array<double, 2>& values) {
  return degrees(values[0]) + " / " + degrees(values[1]);
}

std::array<double, 2> absolute(const std::array<double, 2>& values) {
  return {std::abs(values[0]), std::abs(values[1])};
}

// ---- variants
// ------------------------------------------------------------------------------------

struct Group {
  std::vector<std::string> prefixes;
  const char* title;
  const char* text;
};

std::string variant_row(const RunResult& run, bool with_group) {
  const Gains& g = run.spec.gains;
  std::string row = fmt::format("<tr><td>{}</td><td>{:g}</td><td>{}</td><td>{}</td>",
                                escaped(run_words(run.spec.name, with_group)), run.spec.rate,
                                gains_words(g.k1, g.k2), gains_words(g.b1, g.b2));
  for (std::size_t j = 0; j < 2; ++j)
    row += fmt::format(
        "<td class=\"big{}\">{}</td><td>{}</td><td>{}</td><td>{}</td>", j == 0 ? " first" : "",
        run.stable ? degrees(run.max_deg[j]) : "<span class=no>unstable</span>",
        degrees(std::abs(run.peak_deg[j])), run.stable ? degrees(run.mean_deg[j]) : "–",
        degrees(run.motion_mean_deg[j]));
  const bool too_long = run.interval() > run.step_limit;
  const std::string limit = std::isinf(run.step_limit) ? "none" : rounded(1e3 * run.step_limit);
  return row + fmt::format("<td class=first>{} / {}</td><td>{}</td><td>{}</td></tr>\n",
                           rounded(run.frequency[0]), rounded(run.frequency[1]),
                           rounded(1e3 * run.interval()),
                           too_long ? "<span class=no>" + limit + "</span>" : limit);
}

std::string variant_group(const std::vector<RunResult>& variants, const Group& group) {
  std::string rows;
  for (const RunResult& run : variants)
    for (const std::string& prefix : group.prefixes)
      if (run.spec.name.starts_with(prefix)) rows += variant_row(run, group.prefixes.size() > 1);
  if (rows.empty()) return "";
  return fmt::format(
             "<h3>{}</h3>\n<p>{}</p>\n<div class=scroll><table class=dense><thead>\n"
             "<tr><th rowspan=2>run</th><th rowspan=2>rate<br>Hz</th><th rowspan=2>k"
             "</th><th rowspan=2>b</th><th colspan=4 class=first>joint 1, degrees</th>"
             "<th colspan=4>joint 2, degrees</th><th rowspan=2 class=first>natural<br>rad/s</th>"
             "<th rowspan=2>interval<br>ms</th><th rowspan=2>limit<br>ms</th></tr>\n"
             "<tr><th class=first>max</th><th>predicted</th><th>mean</th><th>predicted</th>"
             "<th>max</th><th>predicted</th><th>mean</th><th>predicted</th></tr></thead>\n<tbody>",
             group.title, group.text) +
         rows + "</tbody></table></div>\n";
}

}  // namespace

std::string rates_section(const StudyResults& results, const Gallery& gallery) {
  const std::pair<const char*, const char*> laws[] = {
      {"printed-torsional", "torsional, as printed"},
      {"signed-torsional", "torsional, damper mended"},
      {"signed-torsional-ratio", "the same, k<sub>2</sub> = 0.2 k<sub>1</sub>"},
      {"printed-linear", "linear, as printed"}};
  std::set<double> rates;
  for (const RunResult& run : results.variants)
    if (run.spec.name.starts_with("trial/")) rates.insert(run.spec.rate);
  if (rates.empty()) return "";
  std::string html =
      "<h2 id=rates>Update rates</h2>\n<p>Gains as the paper found them, by trial: for each law "
      "and "
      "rate, the one k and b with the smallest largest errors, searched over several sweep times "
      "so "
      "that no resonance is exploited. The table shows the paper's own motion, sweeps of 1 s; the "
      "step is 1/rate. Largest error in degrees, joint 1 / joint 2; below it, small, the peak "
      "after "
      "a reversal that linear theory predicts.</p>\n"
      "<div class=scroll><table><thead><tr><th>rate</th>";
  for (const auto& [law, words] : laws) html += fmt::format("<th>{}</th>", words);
  html += "</tr></thead><tbody>\n";
  for (double rate : rates) {
    html += fmt::format("<tr><td>{:g} Hz</td>", rate);
    for (const auto& [law, words] : laws) {
      const RunResult* run = find(results.variants, fmt::format("trial/{}/{:g}", law, rate));
      html += !run          ? "<td>–</td>"
              : run->stable ? "<td>" + pair_of(run->max_deg) + "<br><small>" +
                                  pair_of(absolute(run->peak_deg)) + "</small></td>"
                            : "<td class=no>unstable</td>";
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n" +
         gallery.figure(
             "rates",
             "<b>Largest error against the update rate</b>, both axes logarithmic. "
             "A line of slope −1 means: the error is proportional to the step, because the step "
             "limits the gains. Thin and dotted: the peak after a reversal that linear theory "
             "predicts for the same gains.");
}

std::string recordings_section(const StudyResults& results) {
  if (results.recordings.empty()) return "";
  const auto link = [](const std::filesystem::path& file, const char* words) {
    const std::string name = escaped("recordings/" + file.filename().string());
    return file.empty() ? std::string("–") : fmt::format("<a href=\"{}\">{}</a>", name, words);
  };
  std::string html =
      "<h2 id=recordings>Recordings</h2>\n<p>Each run again as a scene, recorded: the page "
      "replays it in three dimensions; <code>twinarm render</code>, <code>inspect</code> and "
      "<code>replay</code> take the recording. <i>Apart</i>: the largest difference of an angle "
      "from the run of this report.</p>\n<div class=scroll><table><thead><tr><th>run</th>"
      "<th class=text>what</th><th class=text>replay</th><th class=text>recording</th>"
      "<th class=text>scene</th><th>apart, degrees</th></tr></thead><tbody>\n";
  for (const StudyRecording& run : results.recordings)
    html += fmt::format(
        "<tr><td>{}</td><td class=text>{}</td><td class=text>{}</td><td class=text>{}</td>"
        "<td class=text>{}</td><td>{}</td></tr>\n",
        escaped(run.name), escaped(run.title), link(run.page, "page"),
        link(run.recording, "recording"), link(run.scene, "scene"), degrees(run.apart_deg));
  return html + "</tbody></table></div>\n";
}

std::string variants_section(const StudyResults& results, const Gallery& gallery) {
  const Group groups[] = {{{"trial/"},
                           "Gains by trial",
                           "The best gains of each law and rate, as in the section above."},
                          {{"matched/"},
                           "Matched gains",
                           "The linear coupling of the trial, and a torsional one with its full "
                           "stiffness K<sub>q</sub> "
                           "and damping B<sub>q</sub> in joint space: the fair comparison."},
                          {{"explicit/", "semi-implicit/", "implicit/"},
                           "The same springs in three treatments",
                           "Stiff springs (their frequency: see settings), explicit, with an "
                           "implicit damper, and fully "
                           "implicit."},
                          {{"held/"},
                           "Force held",
                           "Gains by trial, the force recomputed at the rate and held between, "
                           "physics at about 1 kHz."},
                          {{"ablation/"}, "Changes to the law", "One at a time, at 60 Hz."}};
  std::string html;
  for (const Group& group : groups) html += variant_group(results.variants, group);
  if (html.empty()) return "";
  return "<h2 id=variants>Variants, with their predictions</h2>\n<p>Automatic motion. "
         "<i>Predicted</i>: the largest error after one reversal by linear theory about the start "
         "pose, beside the measured maximum; beside the measured mean that of the whole motion, "
         "its "
         "jumps one after the other. <i>Natural</i>: both natural frequencies. "
         "<i>Interval</i>: between two evaluations of the coupling. <i>Limit</i>: the largest "
         "stable one of that scheme, of a force that is held and of an older difference too; in "
         "red where the interval is longer. "
         "k and b: on link 1; on link 2 where it differs; N m/rad and N m s/rad (torsional), N/m "
         "and N s/m (linear). The damper "
         "as printed has no linear part, so its prediction is undamped.</p>\n" +
         html +
         gallery.figure(
             "prediction",
             "<b>Prediction beside measurement</b>, both joints of every stable variant. "
             "On the line the linear theory is right. Above it: errors left from earlier "
             "reversals, centrifugal load, or a step too near its limit.");
}

}  // namespace twinarm
