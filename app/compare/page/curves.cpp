#include "app/compare/page/page.h"

#include "app/support/progress.h"

namespace twinarm::compare_page {
namespace {

constexpr long kMaxSteps = 50000;                // of the run that is drawn
constexpr long kFinestSteps = 4000, kSteps = 5;  // of those in the figure of errors
constexpr std::size_t kManyDofs = 60;            // with which implicit steps are slow
constexpr int kExactPoints = 24;

double end_of(const TrajectoryCase& c) {
  return c.events.count > 0 ? c.reference(c.events.count)[0] : c.times.back();
}

// Reference at its times or events; at equal intervals if it is known for all times.
void sample_reference(const TrajectoryCase& c, double until, CaseCurves& curves) {
  std::vector<double> arguments = c.times;
  for (int n = 1; n <= c.events.count; ++n) arguments.push_back(n);
  if (c.takes_any_integrator() && c.events.count == 0 && !c.at_times_only) {
    arguments = {0};
    for (int n = 1; n <= kExactPoints; ++n) arguments.push_back(until * n / kExactPoints);
  }
  if (arguments.size() > 4 * kExactPoints) arguments.clear();  // a bound, not a motion
  curves.exact.resize(curves.names.size());
  for (const double argument : arguments) {
    CaseReadings exact = c.reference(argument);
    double t = argument;
    if (c.events.count > 0) {
      t = exact[0];
      exact.erase(exact.begin());
      exact.push_back(0);  // the event function
    }
    if (t > until * (1 + 1e-9)) continue;
    curves.exact_t.push_back(t);
    for (std::size_t i = 0; i < curves.names.size() && i < exact.size(); ++i)
      curves.exact[i].push_back(exact[i]);
  }
}

// q and -q are the same attitude: chooses the sign of the run.
void choose_signs(CaseCurves& curves) {
  const auto first = std::ranges::find(curves.names, "qw");
  const auto qw = static_cast<std::size_t>(first - curves.names.begin());
  if (qw + 4 > curves.names.size()) return;
  for (std::size_t n = 0; n < curves.exact_t.size(); ++n) {
    const auto after = std::ranges::lower_bound(curves.t, curves.exact_t[n]);
    const auto at =
        std::min(static_cast<std::size_t>(after - curves.t.begin()), curves.t.size() - 1);
    double dot = 0;
    for (std::size_t k = qw; k < qw + 4; ++k) dot += curves.values[k][at] * curves.exact[k][n];
    for (std::size_t k = qw; dot < 0 && k < qw + 4; ++k) curves.exact[k][n] *= -1;
  }
}

void record(const TrajectoryCase& c, CaseCurves& curves) {
  const double end = end_of(c), longest = static_cast<double>(kMaxSteps) * c.integration.step;
  const bool adaptive = c.integration.integrator == Integrator::dopri5;
  const double until = adaptive ? end : std::min(end, longest);
  curves.is_cut = until < end;
  curves.names = c.readings;
  TrajectoryCase shown = c;
  shown.events = {};
  shown.times = {until};
  shown.reference = [](double) { return CaseReadings{}; };
  shown.measure = [](const CaseReadings&, const CaseReadings&) { return 0.0; };
  if (c.events.count > 0) {
    // The event function is drawn too.
    curves.names.push_back(kEventFunction);
    shown.observe = [&c](const Model<double>& model, const State<double>& x) {
      CaseReadings seen = c.observe(model, x);
      seen.push_back(c.events.zero(model, x));
      return seen;
    };
  }
  std::vector<TrajectoryPoint> points;
  const TrajectoryResult run = run_trajectory(shown, c.integration, &points);
  double max_error = 0;
  for (const TrajectoryPoint& p : points)
    max_error = std::max(max_error, std::abs(p.energy - points[0].energy));
  curves.energy_is_relative = run.energy_drift.has_value();
  const double scale = max_error > 0 ? run.energy_drift.value_or(0) / max_error : 0;
  if (curves.energy_is_relative) curves.energy_label = "(E − E₀) / max kinetic energy  [1]";
  curves.values.resize(curves.names.size());
  curves.energy.resize(1);
  for (const TrajectoryPoint& p : points) {
    curves.t.push_back(p.t);
    curves.energy[0].push_back(curves.energy_is_relative ? (p.energy - points[0].energy) * scale
                                                         : p.energy);
    for (std::size_t i = 0; i < curves.names.size() && i < p.seen.size(); ++i)
      curves.values[i].push_back(p.seen[i]);
  }
  sample_reference(c, until, curves);
  choose_signs(curves);
}

ErrorCurve error_curve(const TrajectoryCase& c, Integrator integrator, double end, double finest) {
  ErrorCurve curve{integrator, {}, {}, {}};
  if (integrator == Integrator::dopri5) {
    for (const double tolerance : {1e-12, 1e-10, 1e-8, 1e-6, 1e-4}) {
      check_interrupt();
      const TrajectoryResult run = run_trajectory(c, dopri5_with(tolerance));
      if (!std::isfinite(run.error) || run.steps == 0) continue;
      curve.step.push_back(end / static_cast<double>(run.steps));
      curve.error.push_back(run.error);
    }
    return curve;
  }
  std::vector<double> all;  // including those that are not finite
  // Implicit schemes skip the short steps, which would take most of the time.
  const int first = facts_of(integrator).solves ? 2 : 0;
  double h = finest * (1 << first);
  for (int i = first; i < kSteps; ++i, h *= 2) {
    check_interrupt();
    all.push_back(run_trajectory(c, {integrator, h}).error);
    if (!std::isfinite(all.back())) continue;
    curve.step.push_back(h);
    curve.error.push_back(all.back());
  }
  curve.order = slope_of(all, rounding_of(c));
  return curve;
}

}  // namespace

CaseCurves curves_of(const TrajectoryCase& original, double own_error) {
  TrajectoryCase c = original;
  c.reference = cached(original.reference);
  CaseCurves curves;
  record(c, curves);
  if (!c.takes_any_integrator()) return curves;
  c.scene = [scene = original.scene] {
    CaseScene all = scene();
    all.conserves = false;  // its energy is not needed
    return all;
  };
  const double end = end_of(c);
  double finest = c.integration.integrator == Integrator::dopri5 ? 1e-3 : c.integration.step;
  while (end / finest > static_cast<double>(kFinestSteps)) finest *= 2;
  if (c.scene().model.nv > kManyDofs) finest *= 4;
  for (const IntegratorFacts& facts : all_integrators) {
    ErrorCurve curve = error_curve(c, facts.integrator, end, finest);
    // The error of the case's own step is known, even if that step is too short for this figure.
    if (facts.integrator == c.integration.integrator && c.integration.step < finest &&
        std::isfinite(own_error)) {
      curve.step.insert(curve.step.begin(), c.integration.step);
      curve.error.insert(curve.error.begin(), own_error);
    }
    curves.errors.push_back(curve);
  }
  return curves;
}

}  // namespace twinarm::compare_page
