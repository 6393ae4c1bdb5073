// The cases of mechanisms without loops and contacts, one file for each kind.
#pragma once

#include <vector>

#include "benchmarks/analytic/support/analytic_case.h"

namespace twinarm {

const std::vector<CaseFamily>& joint_cases();  // made by twinarm_registry()

CaseFamily pendulum_cases();         // B1, B2
CaseFamily double_pendulum_cases();  // C1, C2, C10

}  // namespace twinarm
