// The cases of rigid contact, group E of docs/cases.md, one file for each kind; and the tasks of
// other engines (H1).
//
// Steps are 1 ms where nothing else is said. Event times shall be met within one step, velocities
// to 1e-3 of themselves; a place is measured by the time that its error is worth, at the speed
// there.
#pragma once

#include <numbers>
#include <vector>

#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {

const std::vector<CaseFamily>& contact_cases();  // made by twinarm_registry()

inline constexpr double kBallRadius = 0.1;  // of the balls of several cases [m]

inline Matrix3 axis_along_y() {  // of a cylinder that rolls along x
  return turn_about(Vector3::UnitX(), std::numbers::pi / 2);
}

}  // namespace twinarm
