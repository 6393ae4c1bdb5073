// Parts of figures.cpp, one function for each figure.
#pragma once

#include "app/plot/gnuplot.h"
#include "app/study/findings/results.h"

namespace twinarm {

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
