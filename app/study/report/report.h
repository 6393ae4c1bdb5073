// Output of the study: figures, CSV, JSON, and a report.
#pragma once

#include <filesystem>
#include <string>

#include "app/study/findings/results.h"

namespace twinarm {

// Writes the figures as SVG by gnuplot into the folder. Throws InputError if gnuplot or the folder
// is missing.
//   fig6a fig6b fig7c fig7d  angles of KVR and DVR over time (the paper's Figures 6 and 7)
//   errors                   |error| of E3 and E4 over time
//   rates                    largest error against the update rate, optimal gains
//   search                   best fit to the paper's rows against the rate
//   ablations                largest error of each change to the law
//   prediction               predicted peak after a reversal against the measured maximum
//   identify                 intervals of the parameters that agree with the paper's rows
//   obstacle                 the run into the box, both couplings
void write_figures(const StudyResults& results, const std::filesystem::path& folder);

// Writes NAME.csv for each run of the reproduction and of the variants, obstacle_NAME.csv for the
// obstacle; slashes in names become underscores. Columns `name[unit]`: t[s], q_K/joint1[rad], ...,
// q_D/joint1[rad], ..., pull/joint1[N] or [N m]. Numbers are the shortest text that reads back the
// same double. Throws InputError if the folder cannot be written.
void write_csv(const StudyResults& results, const std::filesystem::path& folder);

// The study as one JSON object (docs/reference/study_files.md).
// {"runs": {"E1": {"max_deg": {"joint1", "joint2"}, "mean_deg", "paper", "gains", "step", ...}},
//  "variants": [..], "findings": [..], "obstacle": [..], "answer": [..], "report": PATH, ...}.
// Lengths in m, times in s, rates in Hz; angles in degrees for keys that end with _deg. Numbers
// that are not finite are null.
std::string study_json(const StudyResults& results, const std::string& report_path);
// Result of `--ask`, with its profiles and directions.
std::string answer_json(const Identification& found);

// Writes folder/report.html, self-contained: assets/study/report.html with its placeholders
// replaced by numbers, tables, and the SVGs and PNGs of folder/figures and folder/pictures. Throws
// InputError if the text has an unknown placeholder.
void write_report(const StudyResults& results, const std::filesystem::path& assets,
                  const std::filesystem::path& folder);

}  // namespace twinarm
