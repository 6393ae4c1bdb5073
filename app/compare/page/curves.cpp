#include "app/compare/page/curves.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "app/support/progress.h"
#include "solver/integration/integrator.h"

namespace twinarm::compare_page {
namespace {

constexpr long kMaxSteps = 50000;                // of the run that is drawn
constexpr long kFinestSteps = 4000, kSteps = 5;  // of those in the diagram of errors
constexpr std::size_t kMany = 60;                // dofs of which implicit steps take long
constexpr int kExactPoints = 24;

// References may cost more than a run; every run asks for the same.
std::function<CaseReadings(double)> remembered(std::function<CaseReadings(double)> reference) {
  return [reference = std::move(reference),
          known = std::map<double, CaseReadings>()](double t) mutable {
    const auto found = known.find(t);
    return found != known.end() ? found->second : known.emplace(t, reference(t)).first->second;
  };
}

double end_of(const TrajectoryCase& c) {
  return c.events.count > 0 ? c.reference(c.events.count)[0] : c.times.back();
}

// Where the reference stands: at its times or events, and between them where it is known for all
// times.
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
      exact.push_back(0);  // of what passes zero
    }
    if (t > until * (1 + 1e-9)) continue;
    curves.exact_t.push_back(t);
    for (std::size_t i = 0; i < curves.names.size() && i < exact.size(); ++i)
      curves.exact[i].push_back(exact[i]);
  }
}

// Two quaternions stand for each attitude: the one on the run's side is shown.
void choose_sides(CaseCurves& curves) {
  const auto first = std::find(curves.names.begin(), curves.names.end(), "qw");
  const auto qw = static_cast<std::size_t>(first - curves.names.begin());
  if (qw + 4 > curves.names.size()) return;
  for (std::size_t n = 0; n < curves.exact_t.size(); ++n) {
    const auto after = std::lower_bound(curves.t.begin(), curves.t.end(), curves.exact_t[n]);
    const auto at =
        std::min(static_cast<std::size_t>(after - curves.t.begin()), curves.t.size() - 1);
    double side = 0;
    for (std::size_t k = qw; k < qw + 4; ++k) side += curves.seen[k][at] * curves.exact[k][n];
    for (std::size_t k = qw; side < 0 && k < qw + 4; ++k) curves.exact[k][n] *= -1;
  }
}

void record(const TrajectoryCase& c, CaseCurves& curves) {
  const double end = end_of(c), longest = static_cast<double>(kMaxSteps) * c.integration.step;
  const bool adaptive = c.integration.integrator == Integrator::dopri5;
  const double until = adaptive ? end : std::min(end, longest);
  curves.cut = until < end;
  curves.names = c.readings;
  TrajectoryCase shown = c;
  shown.events = {};
  shown.times = {until};
  shown.reference = [](double) { return CaseReadings{}; };
  shown.measure = [](const CaseReadings&, const CaseReadings&) { return 0.0; };
  if (c.events.count > 0) {
    // The function whose zeros are the events is drawn too.
    curves.names.push_back(kEventFunction);
    shown.observe = [&c](const Model<double>& model, const State<double>& x) {
      CaseReadings seen = c.observe(model, x);
      seen.push_back(c.events.zero(model, x));
      return seen;
    };
  }
  std::vector<TrajectoryPoint> points;
  const TrajectoryResult run = run_trajectory(shown, c.integration, &points);
  double strayed = 0;
  for (const TrajectoryPoint& p : points)
    strayed = std::max(strayed, std::abs(p.energy - points[0].energy));
  curves.energy_kept = run.energy_drift.has_value();
  const double scale = strayed > 0 ? run.energy_drift.value_or(0) / strayed : 0;
  if (curves.energy_kept) curves.energy_label = "(E − E₀) / largest kinetic energy  [1]";
  curves.seen.resize(curves.names.size());
  curves.energy.resize(1);
  for (const TrajectoryPoint& p : points) {
    curves.t.push_back(p.t);
    curves.energy[0].push_back(curves.energy_kept ? (p.energy - points[0].energy) * scale
                                                  : p.energy);
    for (std::size_t i = 0; i < curves.names.size() && i < p.seen.size(); ++i)
      curves.seen[i].push_back(p.seen[i]);
  }
  sample_reference(c, until, curves);
  choose_sides(curves);
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
  std::vector<double> all;  // also those that are not finite
  // Schemes that solve an equation in each step would take most of the time.
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

CaseCurves curves_of(const TrajectoryCase& original, double judged) {
  TrajectoryCase c = original;
  c.reference = remembered(original.reference);
  CaseCurves curves;
  record(c, curves);
  if (!c.takes_any_integrator()) return curves;
  c.scene = [scene = original.scene] {
    CaseScene all = scene();
    all.conserves = false;  // nobody asks for its energy
    return all;
  };
  const double end = end_of(c);
  double finest = c.integration.integrator == Integrator::dopri5 ? 1e-3 : c.integration.step;
  while (end / finest > static_cast<double>(kFinestSteps)) finest *= 2;
  if (c.scene().model.nv > kMany) finest *= 4;
  for (const IntegratorFacts& facts : all_integrators) {
    ErrorCurve curve = error_curve(c, facts.integrator, end, finest);
    // Where that would take long the diagram begins with longer steps; the case's own is known.
    if (facts.integrator == c.integration.integrator && c.integration.step < finest && std::isfinite(judged)) {
      curve.step.insert(curve.step.begin(), c.integration.step);
      curve.error.insert(curve.error.begin(), judged);
    }
    curves.errors.push_back(curve);
  }
  return curves;
}

std::vector<Reading> readings_of(const TrajectoryCase& c) {
  const CaseScene scene = c.scene();
  const CaseReadings seen = c.observe(scene.model, scene.start), exact = c.reference(0);
  std::vector<Reading> all;
  for (std::size_t i = 0; i < c.readings.size() && i < seen.size() && i < exact.size(); ++i)
    all.push_back({c.readings[i], seen[i], exact[i]});
  return all;
}

}  // namespace twinarm::compare_page
