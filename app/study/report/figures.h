// The figures of the study, as SVG, by gnuplot.
#pragma once

#include <filesystem>

#include "app/study/findings/results.h"

namespace twinarm {

// Writes into the folder, made where it is not there:
//   fig6a fig6b fig7c fig7d  angles of KVR and DVR over time (the paper's Figures 6 and 7)
//   errors                   |error| over time, E3 beside E4
//   rates                    largest error against the update rate, gains by trial
//   search                   best fit to the paper's rows against the rate
//   ablations                largest error of each change to the law
//   prediction               predicted peak after a reversal beside the measured maximum
//   identify                 how far the paper's rows hold each parameter
//   obstacle                 the run into the box, both couplings
// A figure without data is not made. Throws InputError where gnuplot or the folder is missing.
void write_figures(const StudyResults& results, const std::filesystem::path& folder);

}  // namespace twinarm
