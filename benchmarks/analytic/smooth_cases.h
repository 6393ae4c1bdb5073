// The cases without contact, by what they are about: one file each, one line here each.
#pragma once

#include <vector>

#include "benchmarks/analytic/analytic_case.h"

namespace twinarm::smooth_cases {

std::vector<AnalyticCase> symmetric_body();      // A1
std::vector<AnalyticCase> asymmetric_body();     // A2, A3
std::vector<AnalyticCase> heavy_top();           // A4
std::vector<AnalyticCase> floating_tree();       // A5
std::vector<AnalyticCase> pendulum();            // B1, B2
std::vector<AnalyticCase> compound_pendulum();   // B3
std::vector<AnalyticCase> sliding_joints();      // B4, B5, B9
std::vector<AnalyticCase> oscillators();         // B6
std::vector<AnalyticCase> spherical_pendulum();  // B7
std::vector<AnalyticCase> universal_joint();     // B8

}  // namespace twinarm::smooth_cases
