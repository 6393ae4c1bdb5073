// The cases of integrators, group G, one file for each kind.
#pragma once

#include <vector>

#include "benchmarks/analytic/support/analytic_case.h"

namespace twinarm {

const std::vector<CaseFamily>& integrator_cases();  // made by twinarm_registry()

}  // namespace twinarm
