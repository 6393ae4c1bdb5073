// Steps of many coupled runs, as in parameter maps, with coupling, integration and measures. Time
// of a step relative to that of the batch's aba(), measured alternately, so that the ratio does not
// depend on the load of the machine; and steps per second by cells, threads and lanes, which
// scripts/measure/map_throughput draws.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>

#include "benchmarks/drivers/command_line.h"
#include "benchmarks/drivers/map_runs.h"
#include "benchmarks/drivers/timing.h"
#include "coupling/batch/batch_model.h"
#include "solver/dynamics/dynamics.h"
#include "solver/model/convert_model.h"

namespace twinarm::bench {
namespace {

struct MapBenchOptions {
  bool quick = false, json = false, passes = true, throughput = true;
};

// One line of a table, or one object of a list.
class Rows {
 public:
  Rows(const char* name, bool json) : json_(json) {
    if (json_) std::printf(",\n \"%s\": [", name);
  }
  ~Rows() {
    if (json_) std::printf("]");
  }
  Rows(const Rows&) = delete;
  template <class... T>
  void add(const char* as_json, const char* as_text, T... values) {
    if (json_) std::printf("%s\n  ", first_ ? "" : ",");
    first_ = false;
    std::printf(json_ ? as_json : as_text, values...);
    std::fflush(stdout);
  }

 private:
  bool json_, first_ = true;
};

// All laws and discretizations, alternating with forward dynamics of the batch alone, with the
// lanes of the map: one call for each state.
template <int N>
void compare_with_passes(const MapBenchOptions& options) {
  if (!options.json)
    std::printf("ns per step of a cell and of the batch's aba() alone, one core, %d lanes\n", N);
  Rows rows("passes", options.json);
  using S = Batch<N>;
  const auto model = convert<S>(ModelWithoutFixedJoints(locked_s103()).model);
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
  for (const bool energy : {false, true})
    for (const MapLaw& law : kMapLaws)
      for (const auto discretization :
           {Discretization::explicit_, Discretization::semi_implicit, Discretization::implicit}) {
        MapRuns map(law, discretization, energy, 4 * N, 1, 1.0);
        const std::vector<Timing> times = time_interleaved(
            {[&] { map.run(); }, aba_alone}, options.quick ? 3 : 9, options.quick ? 0.01 : 0.05);
        const double step = times[0].ns / static_cast<double>(map.steps());
        const double aba = times[1].ns / static_cast<double>(states.size() * N);
        rows.add(
            R"({"law": "%s", "discretization": "%s", "energies": %s, "ns": %.3f, "aba_ns": %.3f, "ratio": %.4f})",
            "%-7s %-14s %-13s %7.1f %7.1f  ratio %.2f\n", law.name, name_of(discretization),
            options.json ? (energy ? "true" : "false") : (energy ? "with energies" : ""), step, aba,
            step / aba);
      }
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
void measure_throughput(const MapBenchOptions& options) {
  if (!options.json)
    std::printf("million steps per second by the wall clock, linear semi-implicit, energies too\n");
  Rows rows("throughput", options.json);
  const double duration = options.quick ? 0.3 : 3;
  const std::size_t max_cells = options.quick ? 16 : 1024, max_alone = options.quick ? 4 : 16;
  for (const bool alone : {true, false})
    for (const std::size_t threads : {std::size_t{1}, std::size_t{2}})
      for (std::size_t cells = 1; cells <= (alone ? max_alone : max_cells); cells *= 2)
        for (const bool energy : {true, false}) {
          if (!energy && (alone || cells < max_cells)) continue;
          MapRuns map(kMapLaws[2], Discretization::semi_implicit, energy, cells, threads, duration);
          const Quickest best = quickest(map, alone, options.quick);
          const double steps = static_cast<double>(map.steps()), in = options.json ? 1 : 1e6;
          rows.add(
              R"({"lanes": %zu, "threads": %zu, "cells": %zu, "energies": %s, "steps_per_second": %.6g, "steps_per_cpu_second": %.6g})",
              "%zu lanes, %zu threads, %4zu cells%s: %6.2f, by processor time %6.2f\n",
              alone ? 1 : map.lanes(), threads, cells,
              options.json ? (energy ? "true" : "false") : (energy ? "" : ", no energies"),
              steps / best.wall / in, steps / best.busiest / in);
        }
}

int measure(const MapBenchOptions& options) {
  const Isa isa = best_isa();
  if (options.json) std::printf("{\"isa\": \"%s\"", name_of(isa));
  if (options.passes) {
    if (isa == Isa::v4)
      compare_with_passes<8>(options);
    else
      compare_with_passes<4>(options);
  }
  if (options.throughput) measure_throughput(options);
  if (options.json) std::printf("}\n");
  return 0;
}

}  // namespace
}  // namespace twinarm::bench

int main(int argc, char** argv) {
  using namespace twinarm::bench;
  MapBenchOptions options;
  return run_program("bench_map",
                     "Time of a step of a map, and steps per second.\n\n"
                     "  bench_map [--quick] [--json] [--passes | --throughput]\n",
                     argc, argv,
                     {{"--quick", &options.quick},
                      {"--json", &options.json},
                      {"--passes", [&] { options.throughput = false; }},
                      {"--throughput", [&] { options.passes = false; }}},
                     [&] { return measure(options); });
}
