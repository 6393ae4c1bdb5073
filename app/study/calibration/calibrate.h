// The searches behind assets/study/calibration.json (docs/study.md):
//
//   E3/RATE/LAW        the printed torsional law with one k and b for both links, and the mass of
//                      arm 2 that the paper does not publish, on its E3 row
//   E4/RATE            the printed linear law, gains per link, at the masses of E3, on its E4 row
//   trial/LAW/RATE     gains as the paper found them, by trial: the most stable movement
//   row/ROBOT/LAW/RATE the same search on a two-link robot of the findings
//   chosen             the one rate, law and mass that the study's E1 to E4 use
#pragma once

#include "app/study/calibration/calibration.h"
#include "app/support/progress.h"

namespace twinarm {

// The paper's Table 2 [deg]: maxima of joints 1 and 2, then means.
struct PaperRow {
  std::array<double, 2> max_deg, mean_deg;
};
const std::map<std::string, PaperRow>& paper_table();  // "E1" .. "E4"

// Largest relative error of the four numbers against the paper's row.
double worst_relative_error(const RunResult& result, const PaperRow& row);

// The laws of the searches, by their names in the calibration.
RunSpec e3_spec(const std::string& law, double rate);  // "world-", "world+", "joint-", "joint+"
RunSpec e4_spec(double rate);
RunSpec trial_spec(const std::string& law, double rate);
RunSpec row_spec(const std::string& law, double rate);
const std::vector<std::string>& e3_laws();
const std::vector<std::string>& trial_laws();

struct StudyInputs {
  StudySettings settings;
  RobotDescription s103;
  std::map<std::string, StudyRobot> findings;  // "findings_set0", "findings_10_14", ...
};
StudyInputs load_inputs(const std::filesystem::path& assets);

Calibration calibrate(const StudyInputs& inputs, Progress& progress);

}  // namespace twinarm
