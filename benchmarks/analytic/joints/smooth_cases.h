// The cases without contact, by what they are about: one file each, one line here each.
#pragma once

#include <vector>

#include "benchmarks/analytic/support/analytic_case.h"

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
std::vector<AnalyticCase> double_pendulum();     // C1, C2, C10
std::vector<AnalyticCase> hanging_chain();       // C3, C4, C5
std::vector<AnalyticCase> cart_pole();           // C6, C10
std::vector<AnalyticCase> kapitza();             // C7
std::vector<AnalyticCase> crossed_hinges();      // C8, C9
std::vector<AnalyticCase> puma560_robot();       // F1
std::vector<AnalyticCase> planar_arm();          // F2
std::vector<AnalyticCase> golden_pendulum();     // G1, G2

}  // namespace twinarm::smooth_cases
