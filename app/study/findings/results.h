// All results of the study, for the report, the JSON and the terminal.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/study/calibration/calibration.h"
#include "app/study/study_run.h"

namespace twinarm {

// A claim about the paper or the couplings, checked in this run.
struct Finding {
  std::string section;   // "equal gains", "update rate", ... : heading in the report
  std::string claim;     // one sentence
  std::string measured;  // "17.2/14.6 deg against 4.8/4.5 deg"
  bool holds = false;
};

// Of one number of Table 2 over the operators [deg].
struct Distribution {
  double median = 0, p10 = 0, p90 = 0;  // quantiles
  double percentile = 0;                // of the published number [%]
  bool is_inside() const { return percentile >= 10 && percentile <= 90; }
};
struct ErrorBand {  // quantiles of |error| over time [s, deg]
  std::vector<double> t, p10, median, p90;
};
// E1 or E2 with many synthetic operators (ensemble.h).
struct Ensemble {
  std::string name;
  int seeds = 0, unstable = 0;
  std::array<Distribution, 2> max_deg, mean_deg;  // by joint
  std::array<ErrorBand, 2> band;
};

// Automatic motion into a box.
struct ObstacleRun {
  RunSpec spec;  // "obstacle_linear"; the coupling has the short name
  const StudySettings::Obstacle* obstacle = nullptr;    // of the settings
  std::vector<double> t;                                // [s]
  std::array<std::vector<double>, 2> q_K_deg, q_D_deg;  // joints 1 and 2
  std::vector<double> coupling;       // largest coupling force [N], or torque [N m]
  std::vector<double> contact_force;  // sum of normal forces [N]
  std::vector<double> penetration;    // of the DVR, at the start of the last step [m]
  std::vector<double> beyond;         // of the KVR: depth behind the touched face [m]
  double max_penetration = 0, max_beyond = 0, max_coupling = 0, max_force = 0;
  // Implicit point springs: R_K / r where it came nearest to its limit, this limit, and the time at
  // which the limit was first exceeded [s]; negative: never.
  double target_radius_ratio = 0, target_radius_limit = 0, exceeded_at = -1;
  bool finite = true;                           // false: diverged, and ends there
  double contact_begin = -1, contact_end = -1;  // [s], of the longest contact
};

// Which coupling has the smaller errors at its gains by trial: run and prediction [deg].
struct CouplingOrder {
  std::string robot;
  double rate = 0;                                      // [Hz]
  std::array<double, 2> linear_deg{}, torsional_deg{};  // maxima of both joints
  // Linear theory: reversal_peak_of_motion().
  double linear_peak_deg = 0, torsional_peak_deg = 0;
  bool torsional_smaller() const {
    return torsional_deg[0] + torsional_deg[1] < linear_deg[0] + linear_deg[1];
  }
  bool is_predicted() const {
    return torsional_smaller() == (torsional_peak_deg < linear_peak_deg);
  }
};

// A fit of a row of Table 2, weighed against all that the paper says of its coupling (evidence.h).
struct Evidence {
  std::string row, law;  // of kPaperTable; in words
  double rate = 0;       // [Hz]
  Gains gains;
  double arm2_mass_scale = 1;
  int parameters = 0;                     // fitted ones
  bool is_used = false;                   // in E1 to E4 of this study
  std::array<double, 2> damping_ratio{};  // of both modes, the slow one first
  std::array<double, 4> misfit{};         // table_misfits()
  double figure = 0, user_figure = 0;     // shares of kPaperStatements: of the row, of user_row()
  int user_numbers = 0;  // of the 4 of user_row(), between the 10 and 90 % quantiles of operators
  std::string user_row() const { return row == "E3" ? "E1" : "E2"; }
  bool has_numbers() const { return std::ranges::max(misfit) <= 1; }
  bool is_contradicted() const;
};

// A recorded run (app/study/report/report.h).
struct StudyRecording {
  std::string name, title;
  std::filesystem::path scene, recording, page;  // page: empty if there is none
  double apart_deg = 0;  // largest difference of an angle between scene and study
};

struct StudyResults {
  std::vector<RunResult> reproduction;  // E1, E2, E3, E4, in this order
  std::vector<Ensemble> ensembles;      // of E1, E2
  std::vector<Evidence> evidence;
  std::vector<RunResult> variants;
  std::vector<Finding> findings;
  std::map<std::string, ProtocolErrors> rows;  // of the two-link robots, by calibration entry
  std::vector<CouplingOrder> orders;           // of each robot and rate
  std::vector<ObstacleRun> obstacle;           // linear, torsional, far target
  std::vector<StudyRecording> recordings;
  std::vector<std::string> answer;   // sentences
  std::string operator_description;  // of E1 and E2
  double arm2_mass_scale = 1;
  double seconds = 0;         // wall time of the study
  std::string command;        // command line
  std::string settings_text;  // of settings.toml
  Calibration calibration;
  std::vector<double> search_rates;             // of the fits to E3 and E4 [Hz]
  std::vector<Identification> identifications;  // from Table 2
  // Link and its mass [kg].
  std::vector<std::pair<std::string, double>> link_masses;
};

}  // namespace twinarm
