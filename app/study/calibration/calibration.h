// The paper's unpublished gains, found by search: assets/study/calibration.json.
//
// An entry has its bounds and evaluations besides the result, so that `twinarm study --recalibrate`
// can reproduce the file. Gains are not literals in the code.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/study/paper.h"
#include "app/study/study_run.h"
#include "app/support/progress.h"

namespace twinarm {

struct Parameter {
  std::string name;          // "k", "b", "k1", "arm2_mass_scale", ...
  double low = 0, high = 0;  // bounds; searched on a logarithmic scale
  double value = 0;
  bool is_at_bound() const { return value <= 1.01 * low || value >= 0.99 * high; }
};

struct CalibrationEntry {
  std::string name;  // "E3/125/world-", "trial/printed-torsional/60", "row/findings_set0/linear/60"
  double rate = 0;   // [Hz]
  std::vector<Parameter> parameters;
  double objective = 0;
  long evaluations = 0;
  std::map<std::string, double> numbers;  // results with these parameters: max1_deg, mean1_deg, ...

  double value(const std::string& parameter) const;  // throws std::out_of_range
  // Sets max1_deg, max2_deg, mean1_deg, mean2_deg of the numbers.
  void keep(const std::array<double, 2>& max_deg, const std::array<double, 2>& mean_deg);
  Gains gains() const;  // from k, b, or k1, b1, k2, b2, or k, b and ratio
  // Of a search without the stability limit, if they are beyond it and have smaller errors.
  std::optional<Gains> unstable_gains() const;
};

struct Calibration {
  std::string optimiser;  // name, version, algorithm
  unsigned seed = 0;
  std::map<std::string, CalibrationEntry> entries;

  // Throws InputError if there is no such entry.
  const CalibrationEntry& entry(const std::string& name) const;
  const CalibrationEntry& e3(const std::string& law, double rate) const;
  const CalibrationEntry& e4(double rate) const;
};

Calibration read_calibration(const std::filesystem::path& file);
void write_calibration(const Calibration& calibration, const std::filesystem::path& file);

// Search in the logarithms of the parameters, within their bounds; implemented by NLopt.
enum class Method {
  rugged,      // controlled random search (Price 1983, Kaelo and Ali 2006), then subplex: for the
               // folded law, whose error is discontinuous in the gains
  multistart,  // multi-level single linkage over a Sobol sequence (Kucherenko and Sytsko 2005)
               // with subplex (Rowan 1990) as local search: for the others
  local        // subplex from the current values of the parameters
};
// Deterministic for a given seed. Writes values, objective and number of evaluations.
void minimise(CalibrationEntry& entry, Method method, unsigned seed, int evaluations,
              const std::function<double(const CalibrationEntry&)>& objective);
std::string optimiser_name();

// Largest relative error of the four numbers against the paper's row of the same name.
double worst_relative_error(const RunResult& result);

// Coupling laws of the searches, by their names in the calibration.
inline const std::vector<std::string> kE3Laws{"world-", "world+", "joint-", "joint+"};
inline const std::vector<std::string> kTrialLaws{"printed-torsional", "signed-torsional",
                                                 "signed-torsional-ratio", "printed-linear"};
RunSpec e3_spec(const std::string& law, double rate);
RunSpec e4_spec(double rate);
RunSpec trial_spec(const std::string& law, double rate);
RunSpec row_spec(const std::string& law, double rate);

struct StudyInputs {
  StudySettings settings;
  RobotDescription s103;
  std::map<std::string, StudyRobot> findings;  // "findings_set0", "findings_10_14", ...
};
StudyInputs load_inputs(const std::filesystem::path& assets);

// The searches behind assets/study/calibration.json; entries: docs/reference/study_files.md.
Calibration calibrate(const StudyInputs& inputs, Progress& progress);

}  // namespace twinarm
