// Computes cells of a map in SIMD lanes (coupling/batch/batch_run.h), with the results of
// run_cell() to rounding.
//
// For one robot on its base with couplings only: no contacts, constraints, Coulomb friction or held
// forces; integrator `semi-implicit`; axes: the step, or stiffness, damping, point, delay or speed
// of couplings. Joint limits are not simulated: cells that could reach one are left to run_cell().
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "app/map/cell_measure.h"
#include "app/map/map_job.h"

namespace twinarm {

class CellBatch {
 public:
  // Null if the scene or an axis is not supported. Keeps a reference to the job.
  static std::unique_ptr<CellBatch> of(const MapJob& job);
  ~CellBatch();

  struct Place {
    double x = 0, y = 0;
  };
  // Nothing for cells that are left to run_cell(). Not thread-safe.
  std::vector<std::optional<CellValues>> run(std::span<const Place> places);

 private:
  struct Parts;
  explicit CellBatch(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace twinarm
