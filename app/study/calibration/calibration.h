// The paper's unpublished gains, found by search: assets/study/calibration.json.
//
// Each entry keeps how it was found (optimiser, seed, bounds, evaluations) beside what was found,
// so that `twinarm study --recalibrate` can make the file again and a reader can judge it. Gains
// are never literals in the code.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "app/study/study_run.h"

namespace twinarm {

struct Parameter {
  std::string name;          // "k", "b", "k1", "arm2_mass_scale", ...
  double low = 0, high = 0;  // bounds; searched on a logarithmic scale
  double value = 0;
};

struct CalibrationEntry {
  std::string name;  // "E3/125/world-", "trial/printed-torsional/60", "row/findings_set0/linear/60"
  double rate = 0;   // [Hz]
  std::vector<Parameter> parameters;
  double objective = 0;
  long evaluations = 0;
  std::map<std::string, double> numbers;  // what the parameters give: max1, mean1, robust, ...

  double value(const std::string& parameter) const;  // throws std::out_of_range
  // As max1_deg, max2_deg, mean1_deg, mean2_deg of the numbers.
  void keep(const std::array<double, 2>& max_deg, const std::array<double, 2>& mean_deg);
  Gains gains() const;  // from k, b, or k1, b1, k2, b2, or k, b and ratio
};

struct Calibration {
  std::string optimiser;  // name, version, algorithm
  unsigned seed = 0;
  std::map<std::string, CalibrationEntry> entries;

  // Throws InputError that says to recalibrate where there is no such entry.
  const CalibrationEntry& entry(const std::string& name) const;
};

Calibration read_calibration(const std::filesystem::path& file);
void write_calibration(const Calibration& calibration, const std::filesystem::path& file);

// How the box of the parameters is searched, in the logarithm of each. NLopt's implementations.
enum class Method {
  rugged,      // controlled random search (Price 1983, Kaelo and Ali 2006), then subplex: for the
               // folded law, whose error jumps from one gain to the next
  multistart,  // multi-level single linkage over a Sobol sequence (Kucherenko and Sytsko 2005)
               // with subplex (Rowan 1990) as local search: for the others
  local        // subplex alone, from the values that the parameters have
};
// The same seed gives the same result. Writes the values, the objective and the evaluations.
void minimise(CalibrationEntry& entry, Method method, unsigned seed, int evaluations,
              const std::function<double(const CalibrationEntry&)>& objective);
std::string optimiser_name();

}  // namespace twinarm
