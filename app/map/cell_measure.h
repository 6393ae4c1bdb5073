// Measures of a cell (docs/use/parameter_maps.md). Energies are from the run's energy balance.
//
//   max_error   max over the steps of e(t_n), e the largest |q_K - q_D| of a measured joint
//   mean_error  (1/T) integral of e of one joint, trapezoidal; the largest of them
//   energy      rows `numerical` and `coupling/*/implicit`: energy that the method creates
//   passivity   minimum over time of the input work since the start; at most 0
//   stable      1 if the run reached its end and energy <= 100 A; else 0, and the
//               other measures have
//               no value.  A = KE(0) + energy of the springs at the start + weight times 1 mm
//                            + 25 max over the target's motion of (KE_K + |PE_K - PE_K(0)|)
//
// A is a reference for the energy of the run. 25: a motion after a start and two reversals has up
// to five times the speed of one start.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/run/run.h"

namespace twinarm {

struct MapJob;

enum class MapMeasure { stable, max_error, mean_error, energy, passivity };
inline constexpr std::array<const char*, 5> kMapMeasures{"stable", "max_error", "mean_error",
                                                         "energy", "passivity"};
constexpr const char* name_of(MapMeasure measure) {
  return kMapMeasures[static_cast<std::size_t>(measure)];
}

// All measures of a cell, in the order of kMapMeasures.
using CellValues = std::array<double, kMapMeasures.size()>;
// Of an unstable run.
constexpr CellValues unstable_cell() {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  return {0, kNone, kNone, kNone, kNone};
}

// The joints whose error is measured.
struct MeasuredJoints {
  std::size_t coupling = 0;        // index of the coupling, with its target
  std::vector<std::size_t> iq;     // coordinates
  std::vector<std::string> names;  // as in the model
  bool slide = false;              // some are prismatic (error in m)
  bool turn = false;               // some are revolute (error in rad)
};
// With a moving target the joints that the operator motion moves; else all joints with one degree
// of freedom between link and base.
MeasuredJoints measured_joints(const SceneModel& scene, std::size_t coupling);

// A above [J], or without its spring energy.
double reference_energy(const SimulatePlan& plan, bool with_springs = true);
// Whether the created energy is at most 100 A; false for NaN.
bool is_bounded(double created, double reference);

class CellMeasure {
 public:
  CellMeasure(const SimulatePlan& plan, MeasuredJoints joints);  // the plan must outlive it
  void look(SteppedRun& run);                                    // at the start and after each step
  CellValues values(const SimulateResult& result) const;

 private:
  const SimulatePlan& plan_;
  MeasuredJoints joints_;
  double t_before_ = 0;
  std::vector<double> before_, integral_;  // by joint
  double max_ = 0, min_input_work_ = 0;
};

// Computes cells of a map in SIMD lanes (coupling/batch/batch_run.h), with the results of
// run_cell() to rounding.
//
// For one robot on its base with couplings only: no contacts, constraints, Coulomb friction or held
// forces; integrator `semi-implicit`; axes: the step, or stiffness, damping, point, delay or speed
// of couplings. Joint limits are not simulated: cells that could reach one are left to run_cell().
struct CellPlace {
  double x = 0, y = 0;
};
// The values of the cells at these places; nothing for cells that are left to run_cell(). Not
// thread-safe; keeps a reference to the job.
using CellBatch =
    std::function<std::vector<std::optional<CellValues>>(std::span<const CellPlace> places)>;
// Empty if the scene or an axis is not supported.
CellBatch cell_batch(const MapJob& job);

}  // namespace twinarm
