// E1 and E2 with many synthetic operators: the distribution of each number of Table 2, and where
// the published number lies in it. The paper's operator was not recorded; one draw of an operator
// says little.
#pragma once

#include <vector>

#include "app/study/findings/results.h"
#include "app/support/progress.h"

namespace twinarm {

// E1 and E2 with the operators of the settings, from `seed` on, on all processors.
std::vector<Ensemble> run_ensembles(const StudyInputs& inputs, const StudyRobot& robot,
                                    const Calibration& calibration, unsigned seed,
                                    Progress& progress);

// Distribution of the values; `published` may be any number.
Distribution distribution_of(std::vector<double> values, double published);

}  // namespace twinarm
