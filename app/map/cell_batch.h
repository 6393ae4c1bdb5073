// Cells of a map side by side in the lanes of the processor (coupling/batch/batch_run.h): a fast
// way for scenes that it can do. The numbers are those of run_cell() to rounding.
//
// It takes one robot on its base with couplings alone: nothing that touches, no constraints, no
// Coulomb friction, no held forces; integrator `semi-implicit`; axes that are the step, or the
// stiffness, damping, point, delay or speed of couplings. Joint limits do not act in it: a cell
// that could have met one is left to run_cell().
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
  // Null where the scene, or an axis, is not for it. The job must outlive it.
  static std::unique_ptr<CellBatch> of(const MapJob& job);
  ~CellBatch();

  struct Place {
    double x = 0, y = 0;
  };
  // Nothing for a cell that must be run alone. One thread at a time.
  std::vector<std::optional<CellValues>> run(std::span<const Place> places);

 private:
  struct Parts;
  explicit CellBatch(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace twinarm
