// What a row of the paper's Table 2 tells of a coupling's gains, and what it leaves open.
//
// A row prints four numbers to a tenth of a degree; a set of parameters theta agrees with it where
// each of its four numbers x_i lies within half of the last digit of p_i:
//
//   misfit(theta) = max_i |x_i - p_i| / 0.05 deg      agrees iff <= 1
//
// Per law of the family, row and rate: the best fit (several starts within bounds); its
// sensitivity d x_i / d log theta_j, whose singular values say how far a combination of parameters
// can move before the row shows it; and the profile of the misfit along each parameter, the least
// misfit with that one held and all others fitted again (Raue et al., Bioinformatics 25, 2009).
// Only k/m and b/m count: of the masses that the paper does not publish, one ratio is a parameter.
#pragma once

#include "app/study/calibration/calibration.h"
#include "app/support/progress.h"

namespace twinarm {

// A coupling whose gains are asked for. Gains per link: k1, b1, k2, b2; of a weld its time constant
// and damping ratio. Not asked: a bushing, which is a linear coupling with more gains, and the god
// object, which has none and no error.
struct FamilyLaw {
  std::string name, words;
  CouplingSpec coupling;
};
const std::vector<FamilyLaw>& family_laws();
const FamilyLaw& family_law(const std::string& name);

struct ProfilePoint {
  double value = 0;   // of the parameter that is held
  double misfit = 0;  // least, over all others
  // What these parameters say of a motion that the row does not have: sweeps of kOtherSweep.
  std::array<double, 2> other_max_deg{};
};
constexpr double kHalfDigit = 0.05;  // of the last printed digit of the table [deg]
constexpr double kOtherSweep = 2;    // [s], half the speed of the paper's

struct Profile {
  std::string parameter;
  std::vector<ProfilePoint> points;  // ascending in value
};

struct Identification {
  std::string row, law;                         // "E3", "linear"
  CalibrationEntry fit;                         // the objective is the misfit
  std::vector<double> singular_values;          // [0.05 deg per factor e], descending
  std::vector<std::vector<double>> directions;  // of log theta, one for each of them
  std::vector<Profile> profiles;

  // Misfits up to this count as "not told apart from the best": 1, or twice the best where nothing
  // agrees.
  double allowance() const;
  // Where the profile stays within the allowance, between points by a line in the logarithms; an
  // end that is the profile's own end means: at least so far.
  struct Interval {
    double low = 0, high = 0;
    bool open_low = false, open_high = false;
  };
  Interval interval(const Profile& profile) const;
};

double table_misfit(const RunResult& result, const PaperRow& row);

// All rows, laws and rates; minutes. The same seeds give the same result.
std::vector<Identification> identify(const StudyInputs& inputs, Progress& progress);

// One of them: "ROW/LAW/RATE", any rate [Hz]. Throws InputError where there is no such question.
Identification ask(const StudyInputs& inputs, const std::string& question);

// assets/study/identification.json. Throws InputError.
std::vector<Identification> read_identifications(const std::filesystem::path& file);
void write_identifications(const std::vector<Identification>& all,
                           const std::filesystem::path& file);

}  // namespace twinarm
