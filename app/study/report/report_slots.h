// Parts of report.cpp: values of the placeholders {NAME} of assets/study/report.html.
#pragma once

#include <map>
#include <string>

#include "app/plot/gnuplot.h"
#include "app/study/findings/results.h"
#include "solver/support/text.h"

namespace twinarm {

using Slots = std::map<std::string, std::string>;  // HTML by name

// ---- report_words.cpp, all HTML ----

// A sentence: k1, K_q, 1e-4 and "deg" as k with an index, a power of ten, a degree sign.
std::string typeset(const std::string& text);
// Significant digits; "none" if infinite, a dash if not a number.
std::string rounded(double value, int digits = 3);
std::string degrees(double value);  // two decimals, more below 0.1
// With an SI prefix, "61.4 kN/m"; of no unit: rounded().
std::string quantity(double value, const std::string& unit, int digits = 3);
// One value, or "12.3 N/m; 4.56 kN/m".
std::string gains_words(double first, double second, const std::string& unit = "");
// Of a parameter of a fit, "k1"; linear: of springs between points.
std::string unit_of(const std::string& parameter, bool linear);
std::string symbol_of(const std::string& parameter);

void add_reproduction(const StudyResults& results, Slots& slots);  // Table 2, Figures 6 and 7
// Update rates, variants, recordings.
void add_other_runs(const StudyResults& results, Slots& slots);
void add_obstacle(const StudyResults& results, Slots& slots);
void add_search(const StudyResults& results, Slots& slots);  // and all parameters
void add_identification(const StudyResults& results, Slots& slots);
void add_evidence(const StudyResults& results, Slots& slots);

// Parts of figures.cpp, one function for each figure.

// figures_time.cpp: over time
void draw_angles(Gnuplot& gnuplot, const std::string& name, const RunResult& run);
void draw_ensembles(Gnuplot& gnuplot, const std::vector<Ensemble>& ensembles);
void draw_errors(Gnuplot& gnuplot, const RunResult& torsional, const RunResult& linear);
void draw_obstacle(Gnuplot& gnuplot, const std::vector<ObstacleRun>& runs);

// figures.cpp: over rates and variants
void draw_rates(Gnuplot& gnuplot, const std::vector<RunResult>& variants);
void draw_search(Gnuplot& gnuplot, const StudyResults& results);
void draw_ablations(Gnuplot& gnuplot, const std::vector<RunResult>& variants);
void draw_prediction(Gnuplot& gnuplot, const std::vector<RunResult>& variants);

// figures_identify.cpp
void draw_identification(Gnuplot& gnuplot, const StudyResults& results);

}  // namespace twinarm
