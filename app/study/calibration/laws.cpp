// The laws that are searched and run, and the paper's table.
#include <algorithm>
#include <cmath>

#include "app/study/calibration/calibration.h"
#include "collision/import/urdf/urdf.h"

namespace twinarm {

const std::map<std::string, PaperRow>& paper_table() {
  static const std::map<std::string, PaperRow> table{{"E1", {{10.2, 26.3}, {1.6, 4.1}}},
                                                     {"E2", {{1.7, 4.0}, {0.5, 0.5}}},
                                                     {"E3", {{16.6, 23.5}, {8.6, 5.2}}},
                                                     {"E4", {{3.4, 6.0}, {0.3, 0.6}}}};
  return table;
}

double worst_relative_error(const RunResult& result, const PaperRow& row) {
  if (!result.stable) return 10;
  double worst = 0;
  for (std::size_t j = 0; j < 2; ++j) {
    worst = std::max(worst, std::abs(result.max_deg[j] / row.max_deg[j] - 1));
    worst = std::max(worst, std::abs(result.mean_deg[j] / row.mean_deg[j] - 1));
  }
  return worst;
}

const std::vector<std::string>& e3_laws() {
  static const std::vector<std::string> laws{"world-", "world+", "joint-", "joint+"};
  return laws;
}

RunSpec e3_spec(const std::string& law, double rate) {
  RunSpec spec;
  spec.name = "E3";
  spec.coupling.name = law;
  spec.coupling.printed = true;
  spec.coupling.options.measure = law.starts_with("joint") ? Measure::joint : Measure::world;
  spec.coupling.options.damping_sign = law.ends_with("+") ? 1 : -1;
  spec.rate = rate;
  return spec;
}

RunSpec e4_spec(double rate) {
  RunSpec spec;
  spec.name = "E4";
  spec.coupling.name = "printed-linear";
  spec.coupling.type = CouplingSpec::Type::linear;
  spec.coupling.printed = true;
  spec.rate = rate;
  return spec;
}

const std::vector<std::string>& trial_laws() {
  static const std::vector<std::string> laws{"printed-torsional", "signed-torsional",
                                             "signed-torsional-ratio", "printed-linear"};
  return laws;
}

// All by the printed way of computing velocities; "signed" mends the damping term only.
RunSpec trial_spec(const std::string& law, double rate) {
  RunSpec spec = law == "printed-linear" ? e4_spec(rate) : e3_spec("world-", rate);
  if (law.starts_with("signed")) spec.coupling.options.damper = Damper::vector_;
  spec.coupling.name = law;
  spec.name = law;
  return spec;
}

// Consistent couplings on a KVR whose velocity is the backward difference of its angles; and the
// variants of the findings' sections (d) and (f).
RunSpec row_spec(const std::string& law, double rate) {
  RunSpec spec;
  spec.name = law;
  spec.rate = rate;
  spec.kvr_rates = KvrRates::backward_difference;
  spec.coupling.name = law;
  if (law.starts_with("linear")) spec.coupling.type = CouplingSpec::Type::linear;
  if (law.starts_with("unsigned") || law.starts_with("older") || law.starts_with("euler")) {
    spec.coupling.printed = true;
    spec.coupling.options.damper =
        law.starts_with("unsigned") ? Damper::unsigned_ : Damper::vector_;
    spec.coupling.options.damping_sign = 1;
  }
  if (law.starts_with("older")) spec.coupling.options.difference = Difference::older;
  if (law.starts_with("euler")) spec.integrator = Integrator::euler;
  return spec;
}

StudyInputs load_inputs(const std::filesystem::path& assets) {
  StudyInputs inputs;
  inputs.settings = read_settings(assets);
  inputs.s103 = read_urdf(inputs.settings.urdf);
  for (const char* name : {"findings_set0", "findings_set1", "findings_set2", "findings_10_14"}) {
    const auto file = assets / "robots" / name / (std::string(name) + ".urdf");
    inputs.findings.emplace(name, StudyRobot::findings(read_urdf(file)));
  }
  return inputs;
}

}  // namespace twinarm
