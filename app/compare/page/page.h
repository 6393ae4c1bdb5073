// Page of `twinarm compare --html`: one self-contained file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/compare/compare.h"
#include "app/plot/gnuplot.h"
#include "benchmarks/analytic/support/analytic_case.h"
#include "benchmarks/analytic/support/trajectory_case.h"

namespace twinarm::compare_page {

// Curves of a case for its page: the run with its own integrator and the reference, energy, and the
// error of every integrator against the step.

// Name of the reading that is zero at each event.
inline constexpr const char* kEventFunction = "zero at events";

// One integrator with steps that double, smallest first; without runs that stopped early.
struct ErrorCurve {
  Integrator integrator;
  std::vector<double> step, error;  // mean steps of dopri5 [s]
  std::optional<double> order;
};

struct CaseCurves {
  std::vector<std::string> names;           // of the readings, with unit
  std::vector<double> t;                    // [s]
  std::vector<std::vector<double>> values;  // by reading, then by t
  std::vector<double> exact_t;
  std::vector<std::vector<double>> exact;  // by reading, then by exact_t
  // By run, then by t: (E - E0) / max kinetic energy, E - E0 of a contact case, or E [J].
  std::vector<std::vector<double>> energy;
  std::string energy_label = "energy  [J]";
  bool energy_is_relative = false;  // the first of them
  bool is_cut = false;              // the run continues after the last t
  std::vector<ErrorCurve> errors;   // empty if the case allows its own integrator only
  std::string drawn;                // the reading, if the curves are runs
  std::string no_convergence;       // why there is no error against the step
  std::string convergence_note;     // remark on that error
};

// Runs every integrator with five steps, implicit ones with three: about twenty times the work of
// the case. `own_error`: that of the case with its own integrator and step.
CaseCurves curves_of(const TrajectoryCase& c, double own_error);

// Runs a contact case again, and once with each of five steps. Empty if the case has no plot.
std::optional<CaseCurves> contact_curves_of(const AnalyticCase& c);

// Figures of the case `name` as SVG by gnuplot (plots.cpp); empty without data.
// Readings over time, one panel per unit: the run as a line, the reference as circles.
std::string motion_figure(Gnuplot& gnuplot, const std::string& name, const CaseCurves& curves);
// Error against step on logarithmic axes, all integrators with their slopes.
std::string error_figure(Gnuplot& gnuplot, const std::string& name, const CaseCurves& curves,
                         double tolerance);
std::string energy_figure(Gnuplot& gnuplot, const std::string& name, const CaseCurves& curves);

// File of --html FOLDER or --html FILE.html.
std::filesystem::path page_file(const std::filesystem::path& asked);

// Replaces "mu", "rad/s^2" .. by Unicode characters, and escapes the text for HTML.
std::string in_unicode(std::string words);

// Place of a case in the compiled source.
struct CasePlace {
  std::string file;  // "joints/pendulum.cpp", in benchmarks/analytic/; empty: not found
  std::size_t line = 0;
};
CasePlace place_of(const std::string& case_name);

// Section of one case: statement, figures, place of its code. Runs the case again for the figures,
// with all integrators.
std::string case_section(const CompareRow& row, const std::vector<Integration>& integrations);

// The whole page, sections in the order of rows; `command` is printed in the footer.
std::string page_html(const std::vector<CompareRow>& rows, const std::vector<std::string>& sections,
                      const std::vector<const SkippedCase*>& skipped, const std::string& command,
                      double seconds);

}  // namespace twinarm::compare_page
