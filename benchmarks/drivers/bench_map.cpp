// Steps of many coupled runs, as in parameter maps, with coupling, integration and measures. Time
// of a step relative to that of the batch's aba(), measured alternately, so that the ratio does not
// depend on the load of the machine; and steps per second by cells, threads and lanes, which
// scripts/measure/map_throughput draws.
#include <limits>
#include <nlohmann/json.hpp>

#include "benchmarks/drivers/command_line.h"
#include "benchmarks/drivers/map_runs.h"
#include "benchmarks/drivers/timing.h"
#include "solver/dynamics/dynamics.h"
#include "solver/model/convert_model.h"

namespace twinarm::bench {
namespace {

struct MapBenchOptions {
  bool quick = false, passes = true, throughput = true;
};
using Json = nlohmann::ordered_json;

// All laws and discretizations, alternating with forward dynamics of the batch alone, with the
// lanes of the map: one call for each state.
template <int N>
Json compare_with_passes(bool quick) {
  Json rows = Json::array();
  using S = Batch<N>;
  const auto model = convert<S>(locked_s103());
  Workspace<S> w(model);
  const Forces<S> forces(model);
  std::vector<State<S>> states(8, State<S>(model));
  for (std::size_t k = 0; k < states.size(); ++k)
    for (std::size_t d = 0; d < model.nq; ++d)
      for (int lane = 0; lane < N; ++lane) {
        const double phase = 0.7 * static_cast<double>(d) + 0.3 * lane;
        states[k].q[d].set(lane, std::sin(1.0 + static_cast<double>(k) + phase));
        states[k].qd[d].set(lane, std::cos(2.0 + static_cast<double>(k) + phase));
      }
  const auto aba_alone = [&] {
    for (const State<S>& x : states) passes<S>().aba(model, x, forces, w);
  };
  for (const MapLaw& law : kMapLaws)
    for (const auto discretization :
         {Discretization::explicit_, Discretization::semi_implicit, Discretization::implicit}) {
      MapRuns map(law, discretization, 4 * N, 1, 1.0);
      const std::vector<Timing> times =
          time_interleaved({[&] { map.run(); }, aba_alone}, quick ? 3 : 9, quick ? 0.01 : 0.05);
      const double step = times[0].ns / static_cast<double>(map.steps());
      const double aba = times[1].ns / static_cast<double>(states.size() * N);
      rows.push_back({{"law", law.name},
                      {"discretization", name_of(discretization)},
                      {"ns", step},
                      {"aba_ns", aba},
                      {"ratio", step / aba}});
    }
  return rows;
}

struct Quickest {
  double wall = std::numeric_limits<double>::infinity(), busiest = wall;  // [s]
};

// Minimum of several calls.
Quickest quickest(MapRuns& map, bool alone, bool quick) {
  using Clock = std::chrono::steady_clock;
  Quickest best;
  double all = 0;
  for (int n = 0; n < (quick ? 1 : 3) || (n < 50 && all < (quick ? 0 : 0.15)); ++n) {
    const auto start = Clock::now();
    if (alone)
      map.run_alone();
    else
      map.run_fresh();
    const double took = std::chrono::duration<double>(Clock::now() - start).count();
    best.wall = std::min(best.wall, took);
    best.busiest = std::min(best.busiest, map.busiest());
    all += took;
    if (all > 2) break;
  }
  return best;
}

// Linear springs with implicit dampers.
Json measure_throughput(bool quick) {
  Json rows = Json::array();
  const double duration = quick ? 0.3 : 3;
  const std::size_t max_cells = quick ? 16 : 1024, max_alone = quick ? 4 : 16;
  for (const bool alone : {true, false})
    for (const std::size_t threads : {std::size_t{1}, std::size_t{2}})
      for (std::size_t cells = 1; cells <= (alone ? max_alone : max_cells); cells *= 2) {
        MapRuns map(kMapLaws[2], Discretization::semi_implicit, cells, threads, duration);
        const Quickest best = quickest(map, alone, quick);
        const auto steps = static_cast<double>(map.steps());
        rows.push_back({{"lanes", alone ? 1 : map.lanes()},
                        {"threads", threads},
                        {"cells", cells},
                        {"steps_per_second", steps / best.wall},
                        {"steps_per_cpu_second", steps / best.busiest}});
      }
  return rows;
}

int measure(const MapBenchOptions& options) {
  const Isa isa = best_isa();
  Json all = {{"isa", name_of(isa)}};
  if (options.passes)
    all["passes"] = isa == Isa::v4 ? compare_with_passes<8>(options.quick)
                                   : compare_with_passes<4>(options.quick);
  if (options.throughput) all["throughput"] = measure_throughput(options.quick);
  std::cout << all.dump(1) << '\n';
  return 0;
}

}  // namespace
}  // namespace twinarm::bench

int main(int argc, char** argv) {
  using namespace twinarm::bench;
  CLI::App program("Time of a step of a map, and steps per second; prints JSON.", "bench_map");
  MapBenchOptions options;
  program.add_flag("--quick", options.quick, "short runs of few cells");
  program.add_flag("!--throughput", options.passes, "steps per second alone");
  program.add_flag("!--passes", options.throughput, "time of a step alone");
  return run_program(program, argc, argv, [&] { return measure(options); });
}
