#include "benchmarks/drivers/timing.h"

#include <benchmark/benchmark.h>

#include <stdexcept>

#include "benchmarks/drivers/command_line.h"

namespace twinarm::bench {
namespace {

// Stores the reports of Google Benchmark instead of printing them.
class Collector : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& reported) override {
    runs.insert(runs.end(), reported.begin(), reported.end());
  }
  std::vector<Run> runs;
};

// Runs all registered jobs once, in the order of registration.
std::vector<benchmark::BenchmarkReporter::Run> run_registered(std::size_t expected) {
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector, nullptr, "all");
  if (collector.runs.size() != expected)
    throw std::runtime_error("Google Benchmark reported " + std::to_string(collector.runs.size()) +
                             " runs of " + std::to_string(expected));
  return collector.runs;
}

}  // namespace

std::vector<Timing> time_interleaved(const std::vector<std::function<void()>>& jobs,
                                     int repetitions, double seconds) {
  if (jobs.empty()) return {};
  const auto add = [](const std::function<void()>& job) {
    return benchmark::RegisterBenchmark("all", [&job](benchmark::State& state) {
      for (auto _ : state) job();
    });
  };

  // The first run warms up and determines the number of calls; its time is not used.
  benchmark::ClearRegisteredBenchmarks();
  for (const auto& job : jobs) add(job)->MinTime(seconds);
  const auto first = run_registered(jobs.size());
  benchmark::ClearRegisteredBenchmarks();
  for (std::size_t i = 0; i < jobs.size(); ++i) add(jobs[i])->Iterations(first[i].iterations);

  std::vector<std::vector<double>> times(jobs.size());
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    const auto runs = run_registered(jobs.size());
    for (std::size_t i = 0; i < jobs.size(); ++i) times[i].push_back(runs[i].GetAdjustedCPUTime());
  }

  std::vector<Timing> timings;
  for (const std::vector<double>& t : times) timings.push_back({median_of(t), spread_of(t)});
  return timings;
}

}  // namespace twinarm::bench
