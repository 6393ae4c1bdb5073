// What the page draws of a known motion: the run in its own integration beside the reference, its energy,
// and the error of every integrator against the step.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/plot/gnuplot.h"
#include "benchmarks/analytic/support/analytic_case.h"
#include "benchmarks/analytic/support/trajectory_case.h"

namespace twinarm::compare_page {

// Name of the reading that passes zero at each event.
inline constexpr const char* kEventFunction = "zero at events";

// One integrator over steps that double, smallest first. A run that stopped by itself is not here.
struct ErrorCurve {
  Integrator integrator;
  std::vector<double> step, error;  // of dopri5 the mean step, by its tolerance [s]
  std::optional<double> order;
};

struct CaseCurves {
  std::vector<std::string> names;         // of the readings, with unit
  std::vector<double> t;                  // [s]
  std::vector<std::vector<double>> seen;  // by reading, then by t
  std::vector<double> exact_t;
  std::vector<std::vector<double>> exact;  // by reading, then by exact_t
  // By run, then by t: (E - E0) / the largest kinetic one, E - E0 of a contact case, or E [J].
  std::vector<std::vector<double>> energy;
  std::string energy_label = "energy  [J]";
  bool energy_kept = false;        // the first of them
  bool cut = false;                // the run goes on after the last t
  std::vector<ErrorCurve> errors;  // none where the case takes no other lanes
  std::string drawn;               // the reading, where curves are runs of one
  std::string no_errors;           // why there is no error against the step
  std::string about_errors;        // what is to be said of it
};

// Runs every integrator with five steps, those that solve an equation in each with three: some
// twenty times the work of the case, whose error as it is judged is known.
CaseCurves curves_of(const TrajectoryCase& c, double judged);

// Of a contact case: runs it again, and once for each of five steps. None where nothing moves.
std::optional<CaseCurves> contact_curves_of(const AnalyticCase& c);

// Of a case without steps: what was seen and what should have been.
struct Reading {
  std::string name;
  double seen, exact;
};
std::vector<Reading> readings_of(const TrajectoryCase& c);

// The figures of one case, as SVG, by gnuplot, in the style of the study's (plots.cpp).
// `name` is that of the case. Each is empty where there is nothing to draw.
// The readings over time, one panel for each unit: the run as a line, the reference as circles.
std::string motion_figure(Gnuplot& gnuplot, const std::string& name, const CaseCurves& curves);
// Error against step on logarithmic axes, all integrators, with their slopes.
std::string error_figure(Gnuplot& gnuplot, const std::string& name, const CaseCurves& curves,
                         double tolerance);
std::string energy_figure(Gnuplot& gnuplot, const std::string& name, const CaseCurves& curves);

}  // namespace twinarm::compare_page
