// Slots of the report on the runs: Table 2, Figures 6 and 7, variants, recordings.
#include <fmt/format.h>

#include <cmath>
#include <set>

#include "app/study/findings/findings.h"
#include "app/study/findings/variants.h"
#include "app/study/report/report_slots.h"
#include "app/support/text.h"

namespace twinarm {
namespace {

constexpr double kNear = 0.15;  // of a published number

bool has_theory(const RunResult& run) {  // of the automatic motion only
  return run.spec.name >= std::string("E3");
}

// Two runs of Table 2.
std::string comparison_table(const std::vector<const RunResult*>& runs) {
  std::string top = "<tr><th rowspan=2>degrees</th>", second = "<tr>", body;
  for (const RunResult* run : runs) {
    top += fmt::format("<th colspan=5 class=\"first text\">{}: {}</th>", run->spec.name,
                       escaped(run->spec.title));
    second +=
        "<th class=first>measured</th><th>by theory</th><th>published</th><th>deviation</th>"
        "<th>15 %</th>";
  }
  for (std::size_t row = 0; row < 4; ++row) {
    const bool maximum = row < 2;
    const std::size_t j = row % 2;
    body += fmt::format("<tr><td>{}, joint {}</td>", maximum ? "maximum" : "mean", j + 1);
    for (const RunResult* run : runs) {
      const PaperRow& paper = kPaperTable.at(run->spec.name);
      const double measured = maximum ? run->max_deg[j] : run->mean_deg[j];
      const double published = maximum ? paper.max_deg[j] : paper.mean_deg[j];
      const double deviation = measured / published - 1;
      body += fmt::format("<td class=\"first big\">{:.2f}</td><td>{:.2f}</td>", measured,
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

std::string ensemble_table(const StudyResults& results) {
  std::string top = "<tr><th rowspan=2>degrees</th>", second = "<tr>", body;
  for (const Ensemble& all : results.ensembles) {
    const RunResult& shown = *find_run(results.reproduction, all.name);
    top += fmt::format("<th colspan=5 class=\"first text\">{}, {}: {} operators{}</th>", all.name,
                       coupling_words(shown.spec.coupling), all.seeds,
                       all.unstable ? fmt::format(", {} unstable", all.unstable) : "");
    second +=
        "<th class=first>shown</th><th>median</th><th>10 to 90 %</th><th>published</th>"
        "<th>percentile</th>";
  }
  for (std::size_t row = 0; row < 4; ++row) {
    const bool maximum = row < 2;
    const std::size_t j = row % 2;
    body += fmt::format("<tr><td>{}, joint {}</td>", maximum ? "maximum" : "mean", j + 1);
    for (const Ensemble& all : results.ensembles) {
      const RunResult& shown = *find_run(results.reproduction, all.name);
      const PaperRow& paper = kPaperTable.at(all.name);
      const Distribution& number = maximum ? all.max_deg[j] : all.mean_deg[j];
      body += fmt::format(
          "<td class=first>{:.2f}</td><td class=big>{:.2f}</td><td>{:.2f} to {:.2f}</td>"
          "<td>{:.2f}</td><td>{:.0f} %</td>",
          maximum ? shown.max_deg[j] : shown.mean_deg[j], number.median, number.p10, number.p90,
          maximum ? paper.max_deg[j] : paper.mean_deg[j], number.percentile);
    }
    body += "</tr>\n";
  }
  return "<div class=scroll><table class=dense><thead>" + top + "</tr>\n" + second +
         "</tr></thead>\n<tbody>" + body + "</tbody></table></div>\n";
}

struct Reading {               // of one joint of a run
  double largest = 0, at = 0;  // [deg], [s]
  double since_jump = 0;       // since the last velocity step, at a full second [s]
  double at_end = 0;           // largest error in the last fifths of the sweeps [deg]
  double below_one = 0;        // fraction of the samples below 1 degree
  double lag = 0;              // mean error in the direction of motion [deg]
};

Reading read_joint(const RunResult& run, std::size_t j) {
  Reading reading;
  const TrackingSeries& series = run.series;
  const std::vector<double>&q_K = series.q_K[j], &q_D = series.q_D[j];
  const std::size_t samples = series.t.size();
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

std::string angle_caption(const RunResult& run) {
  const Reading one = read_joint(run, 0), two = read_joint(run, 1);
  const std::string head = fmt::format("{}, {}.</b> ", run.spec.name, escaped(run.spec.title));
  if (!run.stable) return head + "The run diverged: it is unstable with these gains.";
  if (!has_theory(run))
    return head +
           fmt::format(
               "Tracking error of the DVR: at most {:.1f}° and {:.1f}°, on average {:.1f}° and "
               "{:.1f}°, below 1° for {:.0f} % and {:.0f} % of the time. The operator motion is "
               "not the paper's: compare the kind of error, not its times.",
               run.max_deg[0], run.max_deg[1], run.mean_deg[0], run.mean_deg[1],
               100 * one.below_one, 100 * two.below_one);
  return head +
         fmt::format(
             "Largest errors: {:.1f}° of joint 1, {:.0f} ms after the last velocity step of the "
             "target, and {:.1f}° of joint 2, {:.0f} ms after it. In the last 0.2 s of the "
             "sweeps, when a damped error has decayed, it is at most {:.2f}° and {:.2f}°. The "
             "mean error in the direction of motion is {:.2f}° and {:.2f}°.",
             one.largest, 1e3 * one.since_jump, two.largest, 1e3 * two.since_jump, one.at_end,
             two.at_end, one.lag, two.lag);
}

std::string pair_of(const std::array<double, 2>& values) {
  return degrees(values[0]) + " / " + degrees(values[1]);
}

std::string variant_row(const RunResult& run) {
  const Gains& g = run.spec.gains;
  const bool linear = run.spec.coupling.type != CouplingSpec::Type::torsional;
  const bool ablation = run.spec.name.starts_with("ablation/");
  std::string row = fmt::format(
      "<tr><td>{}</td><td>{:g}</td><td class=wrap>{}</td><td class=wrap>{}</td>",
      typeset(ablation ? run.spec.title : run_words(run.spec.name)), run.spec.rate,
      gains_words(g.k1, g.k2, unit_of("k", linear)), gains_words(g.b1, g.b2, unit_of("b", linear)));
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

std::string variant_table(const std::vector<RunResult>& variants,
                          const std::vector<std::string>& prefixes) {
  std::string rows;
  for (const RunResult& run : variants)
    for (const std::string& prefix : prefixes)
      if (run.spec.name.starts_with(prefix)) rows += variant_row(run);
  return "<div class=scroll><table class=dense><thead>\n"
         "<tr><th rowspan=2>run</th><th rowspan=2>rate<br>Hz</th><th rowspan=2>k"
         "</th><th rowspan=2>b</th><th colspan=4 class=first>joint 1, degrees</th>"
         "<th colspan=4>joint 2, degrees</th><th rowspan=2 class=first>natural<br>rad/s</th>"
         "<th rowspan=2>interval<br>ms</th><th rowspan=2>limit<br>ms</th></tr>\n"
         "<tr><th class=first>max</th><th>predicted</th><th>mean</th><th>predicted</th>"
         "<th>max</th><th>predicted</th><th>mean</th><th>predicted</th></tr></thead>\n<tbody>" +
         rows + "</tbody></table></div>\n";
}

std::string rates_rows(const StudyResults& results) {
  const std::vector<RunResult>& variants = results.variants;
  std::set<double> rates;
  for (const RunResult& run : variants)
    if (run.spec.name.starts_with("trial/")) rates.insert(run.spec.rate);
  std::string html;
  for (const double rate : rates) {
    html += fmt::format("<tr><td>{:g} Hz</td>", rate);
    for (const std::string& law : kTrialLaws) {
      const RunResult& run = *find_run(variants, fmt::format("trial/{}/{:g}", law, rate));
      html += run.stable
                  ? "<td>" + pair_of(run.max_deg) + "<br><small>" +
                        pair_of({std::abs(run.peak_deg[0]), std::abs(run.peak_deg[1])}) +
                        "</small>" + bound_words(results.calibration.entry(run.spec.name)) + "</td>"
                  : "<td class=no>unstable</td>";
    }
    html += "</tr>\n";
  }
  return html;
}

std::string recordings_rows(const std::vector<StudyRecording>& recordings) {
  const auto link = [](const std::filesystem::path& file, const char* words) {
    const std::string name = escaped("recordings/" + file.filename().string());
    return file.empty() ? std::string("–") : fmt::format("<a href=\"{}\">{}</a>", name, words);
  };
  std::string html;
  for (const StudyRecording& run : recordings)
    html += fmt::format(
        "<tr><td>{}</td><td class=text>{}</td><td class=text>{}</td><td class=text>{}</td>"
        "<td class=text>{}</td><td>{}</td></tr>\n",
        run.name.starts_with("obstacle") ? "obstacle" : escaped(run.name), escaped(run.title),
        link(run.page, "page"), link(run.recording, "recording"), link(run.scene, "scene"),
        degrees(run.apart_deg));
  return html;
}

}  // namespace

void add_reproduction(const StudyResults& results, Slots& slots) {
  const std::vector<RunResult>& runs = results.reproduction;
  slots["table2_user"] = ensemble_table(results);
  slots["table2_automatic"] = comparison_table({&runs.at(2), &runs.at(3)});
  for (const RunResult& run : runs) slots["caption_" + run.spec.name] = angle_caption(run);
  const RunResult &e3 = runs[2], &e4 = runs[3];
  const PaperRow &paper_e3 = kPaperTable.at("E3"), &paper_e4 = kPaperTable.at("E4");
  slots["E4_against_text"] = fmt::format("{:+.0f}", 100 * (e4.max_deg[1] / 4.0 - 1));
  for (std::size_t j = 0; j < 2; ++j) {
    const auto put = [&](const char* name, const char* format, double value) {
      slots[name + std::to_string(j + 1)] = fmt::format(fmt::runtime(format), value);
    };
    put("paper_ratio", "{:.1f}", paper_e3.max_deg[j] / paper_e4.max_deg[j]);
    put("paper_E3_max", "{:.1f}", paper_e3.max_deg[j]);
    put("paper_E4_max", "{:.1f}", paper_e4.max_deg[j]);
    put("E3_mean", "{:.1f}", e3.mean_deg[j]);
    put("E4_mean", "{:.2f}", e4.mean_deg[j]);
  }
}

void add_other_runs(const StudyResults& results, Slots& slots) {
  slots["rates_rows"] = rates_rows(results);
  for (const char* group : {"trial", "matched", "held", "ablation"})
    slots[std::string("variants_") + group] =
        variant_table(results.variants, {std::string(group) + "/"});
  slots["variants_discretizations"] =
      variant_table(results.variants, {"explicit/", "semi-implicit/", "implicit/"});
  slots["recordings_rows"] = recordings_rows(results.recordings);
}

}  // namespace twinarm
