// Curves of a contact case: its experiment, recorded.

#include "app/compare/page/page.h"
#include "app/support/progress.h"
#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm::compare_page {
namespace {

// Result of the recorded case; empty if the recorder was complete before its end.
std::optional<CaseResult> recorded(const AnalyticCase& c, ContactRecorder& recorder) {
  const struct Attached {
    explicit Attached(ContactRecorder* to) { contact_recorder = to; }
    ~Attached() { contact_recorder = nullptr; }
  } attached(&recorder);
  try {
    return c.run();
  } catch (const ContactRecorder::Complete&) {
    return {};
  }
}

// Linear interpolation at the times of another run; NAN after the end.
std::vector<double> at_times(const std::vector<double>& times, const std::vector<double>& t,
                             const std::vector<double>& values) {
  std::vector<double> all;
  std::size_t i = 0;
  for (const double time : times) {
    while (i < t.size() && t[i] < time) ++i;
    if (i == t.size())
      all.push_back(NAN);
    else if (i == 0 || t[i] == time)
      all.push_back(values[i]);
    else
      all.push_back(values[i - 1] +
                    (values[i] - values[i - 1]) * (time - t[i - 1]) / (t[i] - t[i - 1]));
  }
  return all;
}

std::string unit_in(const std::string& reading) {
  return reading.substr(reading.find('['));
}

// Of a bisection the parameter, else the name of the run or of the reading.
std::string curve_name(const ContactCasePlot& plot, const ContactRun& run, std::size_t number,
                       std::size_t reading) {
  const std::string& name = plot.readings[reading];
  if (plot.searched)
    return fmt::format("{} = {:.4g} {}", plot.searched, run.parameter, unit_in(name));
  return plot.runs.empty() ? name : plot.runs[number] + " " + unit_in(name);
}

void add_run(const ContactCasePlot& plot, const ContactRun& run, std::size_t number,
             CaseCurves& all) {
  for (std::size_t k = 0; k < run.values.size(); ++k) {
    all.names.push_back(curve_name(plot, run, number, k));
    all.values.push_back(at_times(all.t, run.t, run.values[k]));
    if (!plot.from_start) continue;
    const double start = run.values[k][0];
    for (double& x : all.values.back()) x -= start;
  }
  std::vector<double> energy = run.energy;
  for (double& e : energy) e -= run.energy[0];
  all.energy.push_back(at_times(all.t, run.t, energy));
}

void add_exact(const ContactCasePlot& plot, CaseCurves& all) {
  constexpr int kPoints = 24;
  all.exact.resize(all.names.size());
  if (!plot.exact) return;
  if (!std::isnan(plot.known_at))
    all.exact_t = {plot.known_at};
  else
    for (int n = 0; n <= kPoints; ++n) all.exact_t.push_back(all.t.back() * n / kPoints);
  for (std::size_t k = 0; k < all.names.size(); ++k)
    for (const double t : all.exact_t) all.exact[k].push_back(plot.exact(k, t));
}

// The case with other steps.
ErrorCurve errors_of(const AnalyticCase& c, double step) {
  ErrorCurve curve{Integrator::semi_implicit, {}, {}, {}};
  std::vector<double> all;
  for (double scale = 0.25; scale <= 4; scale *= 2) {
    check_interrupt();
    ContactRecorder recorder;
    recorder.step_scale = scale;
    all.push_back(recorded(c, recorder)->error);
    if (!std::isfinite(all.back())) continue;
    curve.step.push_back(scale * step);
    curve.error.push_back(all.back());
  }
  constexpr double kRounding = 1e-9;
  curve.order = slope_of(all, kRounding);
  return curve;
}

void add_errors(const ContactCasePlot& plot, const ErrorCurve& curve, CaseCurves& all) {
  constexpr double kSolver = 1e-8;  // relative tolerance of the impulse solver
  const auto worst = std::ranges::max_element(curve.error);
  if (*plot.convergence_note)
    all.convergence_note = plot.convergence_note;
  else if (worst != curve.error.end() && *worst < kSolver)
    all.convergence_note =
        "The error does not depend on the step: it is the tolerance of the impulse solver.";
  else if (curve.order)
    all.convergence_note = "The number after the name is the slope.";
  all.errors.push_back(curve);
}

}  // namespace

std::optional<CaseCurves> contact_curves_of(const AnalyticCase& c) {
  const ContactCasePlot* plot = c.plot.get();
  if (!plot) return {};
  ContactRecorder recorder;
  recorder.read = plot->read;
  recorder.count = std::max<std::size_t>(plot->runs.size(), 1);
  recorder.every = plot->every;
  recorder.until = plot->until;
  recorder.bisects = plot->searched != nullptr;
  recorded(c, recorder);
  CaseCurves all;
  all.energy_label = "E − E₀  [J]";
  for (const ContactRun& run : recorder.runs)
    if (all.t.empty() || run.t.back() > all.t.back()) all.t = run.t;
  for (std::size_t i = 0; i < recorder.runs.size(); ++i) add_run(*plot, recorder.runs[i], i, all);
  add_exact(*plot, all);
  all.is_cut = std::isfinite(plot->until);
  if (plot->searched || !plot->runs.empty())
    all.drawn = plot->readings[0].substr(0, plot->readings[0].find(" ["));
  if (plot->no_convergence)
    all.no_convergence = plot->no_convergence;
  else
    add_errors(*plot, errors_of(c, plot->step), all);
  return all;
}

}  // namespace twinarm::compare_page
