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
#pragma once

#include "app/study/calibration/calibration.h"

namespace twinarm {

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
