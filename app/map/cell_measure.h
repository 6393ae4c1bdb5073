// What a map measures of a run (docs/use/parameter_maps.md). All but the errors are sums of the run's own ledger.
//
//   max_error   max over the steps of e(t_n), e the largest |q_K - q_D| of a measured joint;
//   mean_error  (1/T) integral of e of one joint, trapezoidal; the largest of them
//   energy      the ledger's rows `numerical` and `coupling/*/implicit`: what no law of nature does
//   passivity   the least that the work of the hands, summed from the start, ever was; at most 0
//   stable      1 where the run came to its end and energy <= 100 A; else 0, and the others have no
//               value.  A = KE(0) + energy in the springs at the start + weight times 1 mm
//                         + 25 max over the twin's way of (KE_K + |PE_K - PE_K(0)|)
// A is what the run has by right; 25: the motion that follows a start and two reversals has five
// times the speed that one start gives.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "app/run/run.h"

namespace twinarm {

// docs/use/parameter_maps.md defines them.
enum class MapMeasure { stable, max_error, mean_error, energy, passivity };
inline constexpr std::array<const char*, 5> kMapMeasures{"stable", "max_error", "mean_error",
                                                         "energy", "passivity"};
constexpr const char* name_of(MapMeasure measure) {
  return kMapMeasures[static_cast<std::size_t>(measure)];
}

// All measures of a cell, in the order of kMapMeasures.
using CellValues = std::array<double, kMapMeasures.size()>;
// Of a run that is not stable.
constexpr CellValues unstable_cell() {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  return {0, kNone, kNone, kNone, kNone};
}

// The joints whose error is measured.
struct MeasuredJoints {
  std::size_t coupling = 0;        // whose twin they are compared with
  std::vector<std::size_t> iq;     // coordinates
  std::vector<std::string> names;  // as in the model
  bool slide = false;              // all of them: the error is in metres
  bool turn = false;               // any of them: in radians
};
// Of a coupling that moves: those that its hand turns. Else those of one degree of freedom that
// carry its link.
MeasuredJoints measured_joints(const SceneModel& scene, std::size_t coupling);

// A above [J], or what it is without the springs.
double energy_by_right(const SimulatePlan& plan, bool with_springs = true);
// Whether a run that created so much energy is stable. What is not a number is not.
bool within_reach(double created, double by_right);

class CellMeasure {
 public:
  CellMeasure(const SimulatePlan& plan, MeasuredJoints joints);  // the plan must outlive it
  void look(RunView& run);                                       // at the start and after each step
  CellValues values(const SimulateResult& result) const;

 private:
  const SimulatePlan& plan_;
  MeasuredJoints joints_;
  double t_before_ = 0;
  std::vector<double> before_, integral_;  // by joint
  double max_ = 0, min_put_in_ = 0;
};

}  // namespace twinarm
