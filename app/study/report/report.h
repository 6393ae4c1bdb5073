// Output of the study: figures, CSV, JSON, and a report.
#pragma once

#include <filesystem>
#include <string>

#include "app/study/calibration/calibration.h"
#include "app/study/findings/results.h"
#include "app/study/study_run.h"

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

// Recordings of E1 to E4 and of the runs with the obstacle. Each run is written as a scene, which
// is simulated and recorded as by `twinarm simulate --record`, so that a recording can be replayed
// and branched with the laws of the study. The difference between the angles of scene and study is
// measured.

// Into `folder`: NAME.toml, NAME.twinrec and, if the program contains its pages, NAME.html.
std::vector<StudyRecording> write_recordings(const StudyInputs& inputs, const StudyRobot& robot,
                                             const StudyOperator& hand, const StudyResults& results,
                                             const std::filesystem::path& folder,
                                             Progress& progress);

// Pictures of results.recordings: robot.png, E3.png and E4.png (at their largest errors),
// obstacle-linear.png and obstacle-torsional.png (while the DVR is stopped), rendered without
// display or GPU. paper_view omits the KVR and the springs.
void paint_pictures(const StudyResults& results, const std::filesystem::path& folder,
                    bool paper_view, Progress& progress);

}  // namespace twinarm
