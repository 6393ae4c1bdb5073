// Computes cells of a map in SIMD lanes (coupling/batch/batch_run.h), with the results of
// run_cell() to rounding.
//
// For one robot on its base with couplings only: no contacts, constraints, Coulomb friction or held
// forces; integrator `semi-implicit`; axes: the step, or stiffness, damping, point, delay or speed
// of couplings. Joint limits are not simulated: cells that could reach one are left to run_cell().
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "app/map/cell_measure.h"
#include "app/map/map_job.h"

namespace twinarm {

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
