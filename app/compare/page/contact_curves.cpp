// The curves of a contact case: its own experiment, with somebody who looks on.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/compare/page/curves.h"
#include "app/support/progress.h"
#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm::compare_page {
namespace {

// The case as it is judged, watched; nothing where the recorder had enough before its end.
std::optional<CaseResult> watched(const AnalyticCase& c, ContactRecorder& recorder) {
  std::optional<CaseResult> result;
  contact_recorder = &recorder;
  try {
    result = c.run();
  } catch (const ContactRecorder::Enough&) {
  } catch (...) {
    contact_recorder = nullptr;
    throw;
  }
  contact_recorder = nullptr;
  return result;
}

// At the times of another run, on straight lines; not a number after the end.
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

// Several runs of one reading have their own names, a search tells what was tried.
std::string curve_name(const ContactCasePlot& look, const ContactRun& run, std::size_t number,
                       std::size_t reading) {
  const std::string& name = look.readings[reading];
  if (look.search) return fmt::format("{} = {:.4g} {}", look.search, run.tried, unit_in(name));
  return look.runs.empty() ? name : look.runs[number] + " " + unit_in(name);
}

void add_run(const ContactCasePlot& look, const ContactRun& run, std::size_t number,
             CaseCurves& all) {
  for (std::size_t k = 0; k < run.seen.size(); ++k) {
    all.names.push_back(curve_name(look, run, number, k));
    all.seen.push_back(at_times(all.t, run.t, run.seen[k]));
    if (!look.from_start) continue;
    const double start = run.seen[k][0];
    for (double& x : all.seen.back()) x -= start;
  }
  std::vector<double> energy = run.energy;
  for (double& e : energy) e -= run.energy[0];
  all.energy.push_back(at_times(all.t, run.t, energy));
}

void add_exact(const ContactCasePlot& look, CaseCurves& all) {
  constexpr int kPoints = 24;
  all.exact.resize(all.names.size());
  if (!look.exact) return;
  if (!std::isnan(look.known_at))
    all.exact_t = {look.known_at};
  else
    for (int n = 0; n <= kPoints; ++n) all.exact_t.push_back(all.t.back() * n / kPoints);
  for (std::size_t k = 0; k < all.names.size(); ++k)
    for (const double t : all.exact_t) all.exact[k].push_back(look.exact(k, t));
}

// The same experiment with other steps.
ErrorCurve errors_of(const AnalyticCase& c, double step) {
  ErrorCurve curve{Integrator::semi_implicit, {}, {}, {}};
  std::vector<double> all;
  for (double scale = 0.25; scale <= 4; scale *= 2) {
    check_interrupt();
    ContactRecorder recorder;
    recorder.step_scale = scale;
    all.push_back(watched(c, recorder)->error);
    if (!std::isfinite(all.back())) continue;
    curve.step.push_back(scale * step);
    curve.error.push_back(all.back());
  }
  constexpr double kRounding = 1e-9;
  curve.order = slope_of(all, kRounding);
  return curve;
}

void add_errors(const ContactCasePlot& look, const ErrorCurve& curve, CaseCurves& all) {
  constexpr double kSolver = 1e-8;  // relative; what is below has been left by the impulses' solver
  const auto worst = std::max_element(curve.error.begin(), curve.error.end());
  if (*look.about_steps)
    all.about_errors = look.about_steps;
  else if (worst != curve.error.end() && *worst < kSolver)
    all.about_errors = "No step makes it: the tolerance of the impulses' solver is left.";
  else if (curve.order)
    all.about_errors = "Behind the name stands its slope.";
  all.errors.push_back(curve);
}

}  // namespace

std::optional<CaseCurves> contact_curves_of(const AnalyticCase& c) {
  const ContactCasePlot* look = c.look.get();
  if (!look) return {};
  ContactRecorder recorder;
  recorder.look = look->read;
  recorder.count = std::max<std::size_t>(look->runs.size(), 1);
  recorder.every = look->every;
  recorder.until = look->until;
  recorder.search = look->search != nullptr;
  watched(c, recorder);
  CaseCurves all;
  all.energy_label = "E − E₀  [J]";
  for (const ContactRun& run : recorder.runs)
    if (all.t.empty() || run.t.back() > all.t.back()) all.t = run.t;
  for (std::size_t i = 0; i < recorder.runs.size(); ++i) add_run(*look, recorder.runs[i], i, all);
  add_exact(*look, all);
  all.cut = std::isfinite(look->until);
  if (look->search || !look->runs.empty())
    all.drawn = look->readings[0].substr(0, look->readings[0].find(" ["));
  if (look->no_steps)
    all.no_errors = look->no_steps;
  else
    add_errors(*look, errors_of(c, look->step), all);
  return all;
}

}  // namespace twinarm::compare_page
