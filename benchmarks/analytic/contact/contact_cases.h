// The cases of rigid contact, group E of docs/cases.md, by what they are about.
//
// Steps are 1 ms where nothing else is said. Event times shall be met within one step, velocities
// to 1e-3 of themselves; a place is measured by the time that its error is worth, at the speed
// there.
#pragma once

#include <vector>

#include "benchmarks/analytic/support/analytic_case.h"

namespace twinarm::contact_cases {

std::vector<AnalyticCase> impacts();      // E1, E6, E16
std::vector<AnalyticCase> sliding();      // E2, E5
std::vector<AnalyticCase> toppling();     // E3
std::vector<AnalyticCase> rolling();      // E4
std::vector<AnalyticCase> hollows();      // E12
std::vector<AnalyticCase> painleve();     // E7
std::vector<AnalyticCase> spinning();     // E8, E9, E10
std::vector<AnalyticCase> stacks();       // E11
std::vector<AnalyticCase> arches();       // E13
std::vector<AnalyticCase> wedges();       // E14
std::vector<AnalyticCase> rod_impacts();  // E17

}  // namespace twinarm::contact_cases
