// Slots of the report on the runs: Table 2, Figures 6 and 7, variants, recordings, runs into a box.

#include "app/study/findings/findings.h"
#include "app/study/report/report_slots.h"

namespace twinarm {
namespace {

constexpr double kNear = 0.15;  // of a published number

// Two experiments of Table 2; cells: five of a column, for the maximum or the mean of a joint.
std::string table2(const std::array<std::string, 2>& titles, const std::string& columns,
                   const std::function<std::string(std::size_t, bool, std::size_t)>& cells) {
  std::string top = "<tr><th rowspan=2>degrees</th>", body;
  for (const std::string& title : titles)
    top += "<th colspan=5 class=\"first text\">" + escaped(title) + "</th>";
  for (std::size_t row = 0; row < 4; ++row) {
    const bool maximum = row < 2;
    const std::size_t j = row % 2;
    body += fmt::format("<tr><td>{}, joint {}</td>{}{}</tr>\n", maximum ? "maximum" : "mean", j + 1,
                        cells(0, maximum, j), cells(1, maximum, j));
  }
  return "<div class=scroll tabindex=0><table class=dense><thead>" + top + "</tr>\n<tr>" + columns +
         columns + "</tr></thead>\n<tbody>" + body + "</tbody></table></div>\n";
}

std::string comparison_table(const RunResult& e3, const RunResult& e4) {
  const auto cells = [&](std::size_t r, bool maximum, std::size_t j) {
    const RunResult& run = r == 0 ? e3 : e4;
    const PaperRow& paper = kPaperTable.at(run.spec.name);
    const double measured = maximum ? run.max_deg[j] : run.mean_deg[j];
    const double published = maximum ? paper.max_deg[j] : paper.mean_deg[j];
    const double deviation = measured / published - 1;
    return fmt::format("<td class=\"first big\">{:.2f}</td><td>{:.2f}</td><td>{:.1f}{}</td>",
                       measured, maximum ? run.motion_max_deg[j] : run.motion_mean_deg[j],
                       published, r == 1 && maximum && j == 1 ? " *" : "") +
           (!run.stable || !std::isfinite(deviation)
                ? "<td>–</td><td class=no>unstable</td>"
                : fmt::format("<td>{}{:.1f} %</td><td>{}</td>", deviation < 0 ? "−" : "+",
                              std::abs(100 * deviation),
                              yes_no(std::abs(deviation) <= kNear, "within", "outside")));
  };
  return table2({e3.spec.name + ": " + e3.spec.title, e4.spec.name + ": " + e4.spec.title},
                "<th class=first>measured</th><th>by theory</th><th>published</th>"
                "<th>deviation</th><th>15 %</th>",
                cells);
}

std::string ensemble_table(const StudyResults& results) {
  std::array<std::string, 2> titles;
  for (std::size_t r = 0; r < 2; ++r) {
    const Ensemble& all = results.ensembles.at(r);
    titles[r] =
        fmt::format("{}, {}: {} operators{}", all.name,
                    coupling_words(find_run(results.reproduction, all.name)->spec.coupling),
                    all.seeds, all.unstable ? fmt::format(", {} unstable", all.unstable) : "");
  }
  const auto cells = [&](std::size_t r, bool maximum, std::size_t j) {
    const Ensemble& all = results.ensembles[r];
    const RunResult& shown = *find_run(results.reproduction, all.name);
    const PaperRow& paper = kPaperTable.at(all.name);
    const Distribution& number = maximum ? all.max_deg[j] : all.mean_deg[j];
    return fmt::format(
        "<td class=first>{:.2f}</td><td class=big>{:.2f}</td><td>{:.2f} to {:.2f}</td>"
        "<td>{:.2f}</td><td>{:.0f} %</td>",
        maximum ? shown.max_deg[j] : shown.mean_deg[j], number.median, number.p10, number.p90,
        maximum ? paper.max_deg[j] : paper.mean_deg[j], number.percentile);
  };
  return table2(titles,
                "<th class=first>shown</th><th>median</th><th>10 to 90 %</th><th>published</th>"
                "<th>percentile</th>",
                cells);
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
  return "<div class=scroll tabindex=0><table class=dense><thead>\n"
         "<tr><th rowspan=2>run</th><th rowspan=2>rate<br>Hz</th><th rowspan=2>k"
         "</th><th rowspan=2>b</th><th colspan=4 class=first>joint 1, degrees</th>"
         "<th colspan=4>joint 2, degrees</th><th rowspan=2 class=first>natural<br>rad/s</th>"
         "<th rowspan=2>interval<br>ms</th><th rowspan=2>limit<br>ms</th></tr>\n"
         "<tr><th class=first>max</th><th>predicted</th><th>mean</th><th>predicted</th>"
         "<th>max</th><th>predicted</th><th>mean</th><th>predicted</th></tr></thead>\n<tbody>" +
         rows + "</tbody></table></div>\n";
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

// One column for each run.
std::string obstacle_rows(const std::vector<ObstacleRun>& runs) {
  using R = const ObstacleRun&;
  const auto unit = [](R r, const char* gain) {
    return unit_of(gain, r.spec.coupling.type == CouplingSpec::Type::linear);
  };
  const std::pair<const char*, std::function<std::string(R)>> rows[] = {
      {"discretization", [](R r) { return escaped(discretization_name(r.spec.coupling)); }},
      {"stiffness on link 1; link 2",
       [&](R r) { return gains_words(r.spec.gains.k1, r.spec.gains.k2, unit(r, "k")); }},
      {"damping on link 1; link 2",
       [&](R r) { return gains_words(r.spec.gains.b1, r.spec.gains.b2, unit(r, "b")); }},
      {"longest contact",
       [](R r) {
         return r.contact_begin < 0
                    ? "none"
                    : fmt::format("{:.3f} to {:.3f} s", r.contact_begin, r.contact_end);
       }},
      {"largest penetration of the DVR",
       [](R r) { return fmt::format("{:.3f} mm", 1e3 * r.max_penetration); }},
      {"largest depth of the KVR behind the touched face",
       [](R r) { return fmt::format("{:.0f} mm", 1e3 * r.max_beyond); }},
      {"largest coupling force or torque",
       [](R r) { return quantity(r.max_coupling, r.spec.coupling_force_unit()); }},
      {"largest contact force", [](R r) { return quantity(r.max_force, "N"); }},
      {"R<sub>K</sub>/r where it came nearest to its limit; the limit",
       [](R r) {
         const double limit = r.target_radius_limit;
         return limit > 0 ? gains_words(r.target_radius_ratio, limit) : std::string("–");
       }},
      {"limit exceeded from", [](R r) {
         const std::string end = yes_no(r.finite, "finite", "diverged");
         return r.exceeded_at < 0 ? "–" : fmt::format("{:.3f} s; {}", r.exceeded_at, end);
       }}};
  std::string html = "<tr><th></th>";
  for (R run : runs) html += "<th>" + escaped(run.spec.title) + "</th>";
  html += "</tr></thead><tbody>\n";
  for (const auto& [name, value] : rows) {
    html += fmt::format("<tr><td>{}</td>", name);
    for (R run : runs) html += "<td>" + value(run) + "</td>";
    html += "</tr>\n";
  }
  return html;
}

}  // namespace

void add_reproduction(const StudyResults& results, Slots& slots) {
  const std::vector<RunResult>& runs = results.reproduction;
  slots["table2_user"] = ensemble_table(results);
  slots["table2_automatic"] = comparison_table(runs.at(2), runs.at(3));
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
  for (const char* group : {"trial", "matched", "held", "ablation"})
    slots[std::string("variants_") + group] =
        variant_table(results.variants, {std::string(group) + "/"});
  slots["variants_discretizations"] =
      variant_table(results.variants, {"explicit/", "semi-implicit/", "implicit/"});
  slots["recordings_rows"] = recordings_rows(results.recordings);
}

void add_obstacle(const StudyResults& results, Slots& slots) {
  slots["obstacle_rows"] = obstacle_rows(results.obstacle);
}

}  // namespace twinarm
