#include "app/study/findings/findings.h"

#include "app/support/parallel_for.h"

namespace twinarm {
namespace {

// Of sorted values, linear between them.
double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at), above = std::min(below + 1, sorted.size() - 1);
  if (sorted[below] == sorted[above]) return sorted[below];  // also of unstable runs: infinite
  return std::lerp(sorted[below], sorted[above], at - static_cast<double>(below));
}

// Quantiles of |error| over the operators, in windows of time.
ErrorBand band_of(const std::vector<RunResult>& runs, std::size_t joint) {
  constexpr double kWindow = 0.25;  // [s]
  std::vector<std::vector<double>> windows;
  for (const RunResult& run : runs) {
    const std::vector<double> error = error_deg(run.series, joint);
    for (std::size_t n = 0; n < error.size(); ++n) {
      const auto window = static_cast<std::size_t>(run.series.t[n] / kWindow);
      if (window >= windows.size()) windows.resize(window + 1);
      windows[window].push_back(error[n]);
    }
  }
  ErrorBand band;
  for (std::size_t w = 0; w < windows.size(); ++w) {
    if (windows[w].size() < runs.size()) continue;  // the end, shorter than a window
    std::ranges::sort(windows[w]);
    band.t.push_back((static_cast<double>(w) + 0.5) * kWindow);
    band.p10.push_back(quantile(windows[w], 0.1));
    band.median.push_back(quantile(windows[w], 0.5));
    band.p90.push_back(quantile(windows[w], 0.9));
  }
  return band;
}

Ensemble summary(const RunSpec& spec, const std::vector<RunResult>& runs) {
  Ensemble ensemble{spec.name, static_cast<int>(runs.size()), 0, {}, {}, {}};
  const PaperRow& paper = kPaperTable.at(spec.name);
  for (const RunResult& run : runs) ensemble.unstable += !run.stable;
  for (std::size_t j = 0; j < 2; ++j) {
    std::vector<double> max_deg, mean_deg;
    for (const RunResult& run : runs) {
      max_deg.push_back(run.stable ? run.max_deg[j] : HUGE_VAL);
      mean_deg.push_back(run.stable ? run.mean_deg[j] : HUGE_VAL);
    }
    ensemble.max_deg[j] = distribution_of(max_deg, paper.max_deg[j]);
    ensemble.mean_deg[j] = distribution_of(mean_deg, paper.mean_deg[j]);
    ensemble.band[j] = band_of(runs, j);
  }
  return ensemble;
}

}  // namespace

Distribution distribution_of(std::vector<double> values, double published) {
  std::ranges::sort(values);
  const auto below =
      static_cast<double>(std::ranges::lower_bound(values, published) - values.begin());
  const auto up_to =
      static_cast<double>(std::ranges::upper_bound(values, published) - values.begin());
  return {quantile(values, 0.5), quantile(values, 0.1), quantile(values, 0.9),
          50 * (below + up_to) / static_cast<double>(values.size())};
}

std::vector<Ensemble> run_ensembles(const StudyInputs& inputs, const StudyRobot& robot,
                                    const Calibration& calibration, unsigned seed,
                                    Progress& progress) {
  const StudySettings& settings = inputs.settings;
  const std::vector<RunSpec> specs = reproduction_specs(calibration);
  std::vector<std::vector<RunResult>> runs(2, std::vector<RunResult>(settings.seeds));
  const std::size_t count = 2 * settings.seeds;
  parallel_for(
      count,
      [&](std::size_t n) {
        const auto offset = static_cast<unsigned>(n / 2);
        const SyntheticOperator hand(seed + offset, settings.operator_duration,
                                     settings.operator_ranges);
        runs[n % 2][offset] = run(robot, hand, specs[n % 2]);
      },
      [&](std::size_t done) { progress.advance(done, count); });
  return {summary(specs[0], runs[0]), summary(specs[1], runs[1])};
}

}  // namespace twinarm
