// Where theory says that a map's runs begin to grow (docs/coupling.md), as curves in its plane.
//
// About a pose, with e = q_K - q_D, a step of the couplings is linear; it is stable where no
// eigenvalue of its matrix lies outside the unit circle. Two poses are taken: the start, and the
// worst of those that the twin passes. A point spring that is implicit keeps an explicit rest, the
// turning of its lever arm: the geometric limit of largest_target_radius
// (coupling/analysis/prediction.h), for each joint between the link and the ground, between the
// radii at which link and target stand.
#pragma once

#include <string>
#include <vector>

#include "app/map/map_job.h"

namespace twinarm {

struct MapCurve {
  std::string name;
  std::vector<double> x, y;  // values of the axes; a NaN parts two branches
};

// Nothing where theory has no word: couplings that hold their force, constraints, integrators whose
// step is no polynomial. Found by bisection along columns, to 1e-4 of the axis' length.
std::vector<MapCurve> theory_curves(const MapJob& job);

}  // namespace twinarm
