// The figures of one case, as SVG, by gnuplot, in the style of the study's.
#pragma once

#include <string>

#include "app/compare/page/curves.h"
#include "app/plot/gnuplot.h"

namespace twinarm::compare_page {

// `name` is that of the case. Each is empty where there is nothing to draw.
// The readings over time, one panel for each unit: the run as a line, the reference as circles.
std::string motion_figure(Gnuplot& gnuplot, const std::string& name, const CaseCurves& curves);
// Error against step on logarithmic axes, all integrators, with their slopes.
std::string error_figure(Gnuplot& gnuplot, const std::string& name, const CaseCurves& curves,
                         double tolerance);
std::string energy_figure(Gnuplot& gnuplot, const std::string& name, const CaseCurves& curves);

}  // namespace twinarm::compare_page
