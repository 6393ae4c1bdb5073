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

// ---- identification ----

// Identifiability of a coupling's gains from a row of the paper's Table 2.
//
// A row has four numbers p_i, printed to 0.1 degree; parameters theta agree with it if their
// numbers x_i round to them:
//
//   misfit(theta) = max_i |x_i - p_i| / (half of the last printed digit)      agrees iff <= 1
//
// For each law, row and rate: the best fit (several starts within bounds); its sensitivity
// d x_i / d log theta_j, whose singular values show by how much a combination of parameters can
// change without effect on the row; and the profile of the misfit along each parameter, its minimum
// over all others with that one fixed (Raue et al., Bioinformatics 25, 2009). Only k/m and b/m
// matter: of the unpublished masses one ratio is a parameter.

// A coupling law whose gains are identified: k1, b1, k2, b2 of the links; of a weld its time
// constant and damping ratio. Without the bushing, a linear coupling with more gains, and the god
// object, which has no gains and no error.
struct FamilyLaw {
  std::string name, words;
  CouplingSpec coupling;
  // Whether it is of the kind of the row's experiment: torsional for E3, springs between points for
  // E4.
  bool fits_row(const std::string& row) const {
    return facts_of(coupling.type, coupling.printed).at_point != (row == "E3");
  }
};
const std::vector<FamilyLaw>& family_laws();
const FamilyLaw& family_law(const std::string& name);

struct ProfilePoint {
  double value = 0;   // of the fixed parameter
  double misfit = 0;  // minimum over all others
  // Result of these parameters for another motion: sweeps of kOtherSweep.
  std::array<double, 2> other_max_deg{};
};
constexpr double kOtherSweep = 2;  // [s], half the speed of the paper's

struct Profile {
  std::string parameter;
  std::vector<ProfilePoint> points;  // ascending in value
};

struct Identification {
  std::string row, law;                         // of kPaperTable; "linear"
  CalibrationEntry fit;                         // the objective is the misfit
  std::vector<double> singular_values;          // [0.05 deg per factor e], descending
  std::vector<std::vector<double>> directions;  // of log theta, one for each of them
  std::vector<Profile> profiles;

  // Misfit up to which parameters are indistinguishable from the best: 1, or twice the best if that
  // is larger.
  double threshold() const;
  // Range of the profile below the threshold, interpolated in logarithms; open at an end of the
  // profile.
  struct Interval {
    double low = 0, high = 0;
    bool open_low = false, open_high = false;
  };
  Interval interval(const Profile& profile) const;
};

// Maxima, then means of joints 1 and 2, from a row of kPaperTable; 1e5 if unstable.
std::array<double, 4> table_misfits(const RunResult& result, const std::string& row);

// The run of a fit, named as its row.
struct FittedRun {
  StudyRobot robot;
  RunSpec spec;
};
FittedRun fitted_run(const StudyInputs& inputs, const std::string& row, const FamilyLaw& law,
                     const CalibrationEntry& fit);

// All rows, laws and rates; takes minutes. Deterministic.
std::vector<Identification> identify(const StudyInputs& inputs, Progress& progress);

// One of them, "ROW/LAW/RATE", at any rate [Hz]. Throws InputError.
Identification identify_one(const StudyInputs& inputs, const std::string& problem);

// assets/study/identification.json. Throws InputError.
std::vector<Identification> read_identifications(const std::filesystem::path& file);
void write_identifications(const std::vector<Identification>& all,
                           const std::filesystem::path& file);

}  // namespace twinarm
