// Output of the study: figures, CSV, JSON, and a report.
#pragma once

#include <filesystem>
#include <string>

#include "app/study/findings/results.h"

namespace twinarm {

// Writes the figures (docs/reference/study_files.md) as SVG by gnuplot into the folder. Throws
// InputError if gnuplot or the folder is missing.
void write_figures(const StudyResults& results, const std::filesystem::path& folder);

// Writes NAME.csv for each run; its columns: docs/reference/study_files.md. Numbers are the
// shortest text that reads back the same double. Throws InputError if the folder cannot be written.
void write_csv(const StudyResults& results, const std::filesystem::path& folder);

// The study as one JSON object (docs/reference/study_files.md). Lengths in m, times in s, rates in
// Hz; angles in degrees for keys that end with _deg. Numbers that are not finite are null.
std::string study_json(const StudyResults& results, const std::string& report_path);
// Result of `--identify-one`, with its profiles and directions.
std::string answer_json(const Identification& found);

// Writes folder/report.html, self-contained: assets/study/report.html with its placeholders
// replaced by numbers, tables, and the SVGs and PNGs of folder/figures and folder/pictures. Throws
// InputError if the text has an unknown placeholder.
void write_report(const StudyResults& results, const std::filesystem::path& assets,
                  const std::filesystem::path& folder);

}  // namespace twinarm
