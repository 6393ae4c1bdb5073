// One cell of a map: a run of its scene as `twinarm simulate` makes it, and its measures.
#pragma once

#include "app/map/cell_measure.h"
#include "app/map/map_job.h"

namespace twinarm {

// Throws Interrupted. All of its state is its own: cells run beside one another.
CellValues run_cell(const MapJob& job, const SimulatePlan& plan);

}  // namespace twinarm
