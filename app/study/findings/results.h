// Everything that the study found out, for the report, the JSON and the terminal.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/study/calibration/calibration.h"
#include "app/study/calibration/identify.h"
#include "app/study/study_run.h"

namespace twinarm {

// A claim about the paper or the couplings, re-derived in this run.
struct Finding {
  std::string section;   // "equal gains", "update rate", ... : groups claims in the report
  std::string claim;     // one sentence
  std::string measured;  // the numbers, in words: "17.2/14.6 deg against 4.8/4.5 deg"
  bool holds = false;
};

// The automatic motion with a box in the way.
struct ObstacleRun {
  std::string name;  // "linear", "torsional"
  Gains gains;
  std::string treatment;
  std::vector<double> t;  // [s]
  std::vector<std::array<double, 2>> q_K_deg, q_D_deg;
  std::vector<double> pull;           // largest spring force [N], or couple [N m]
  std::vector<double> contact_force;  // sum of normal forces [N]
  std::vector<double> penetration;    // of the DVR [m]
  std::vector<double> beyond;         // of the KVR: how far past the touched face [m]
  std::string pull_unit;              // "N" or "N m"
  double max_penetration = 0, max_beyond = 0, max_pull = 0, max_force = 0;
  double target_radius_ratio = 0;               // largest R_K / r that occurred (linear)
  double target_radius_limit = 0;               // largest stable R_K / r (linear)
  double contact_begin = -1, contact_end = -1;  // [s], of the longest contact
};

// One line of the table of all rates, of the fits on E3 and E4.
struct SearchRow {
  double rate = 0;
  std::map<std::string, const CalibrationEntry*> e3;  // by law
  const CalibrationEntry* e4 = nullptr;
};

// A run that others can open (recordings.h).
struct StudyRecording {
  std::string name, title;
  std::filesystem::path scene, recording, page;  // the page may be missing: empty
  double apart_deg = 0;  // largest difference of an angle between the scene's run and the study's
};

struct StudyResults {
  std::vector<RunResult> reproduction;  // E1, E2, E3, E4, in this order
  std::vector<RunResult> variants;
  std::vector<Finding> findings;
  std::map<std::string, ProtocolErrors> rows;  // of the two-link robots, by calibration entry
  std::vector<ObstacleRun> obstacle;           // linear, torsional
  std::vector<StudyRecording> recordings;
  std::vector<std::string> answer;  // five lines, each with its number
  std::string hand_description;     // of E1 and E2
  double arm2_mass_scale = 1;
  double seconds = 0;         // that the study took
  std::string command;        // that made it
  std::string settings_text;  // settings.toml as it was used
  Calibration calibration;
  std::vector<SearchRow> search;
  std::vector<Identification> identifications;  // what Table 2 leaves open
  // Parameters of the robot for the report: link, mass [kg], and the unit of the paper.
  std::vector<std::pair<std::string, double>> link_masses;
};

}  // namespace twinarm
