// Error and time per step of every engine on the same scenes. Prints JSON
// (docs/understand/accuracy_vs_other_engines.md); table and figure are made by
// scripts/measure/peers.

#include <exception>
#include <nlohmann/json.hpp>
#include <set>

#include "benchmarks/drivers/command_line.h"
#include "benchmarks/drivers/timing.h"

namespace twinarm::bench {
namespace {

// One engine with one scheme and step in one case.
struct Row {
  Engine* engine;
  std::string name;  // of its kind
  const SceneCase* test;
  Scheme scheme;
  double h;         // or the tolerance
  double expected;  // CPU time of the first run [s]
  double error = NAN;
  long steps = 0;                 // of a fixed step; 0: adaptive
  std::vector<double> seconds{};  // by repetition: CPU time of the whole run
  std::string stopped{};          // why the run is incomplete
};

constexpr double kOnceIsEnough = 2;  // CPU seconds: a run that takes longer is not repeated

// Times at which the error is measured.
std::vector<double> measured_times(const SceneCase& c) {
  if (!c.times.empty()) return c.times;
  std::vector<double> all;
  for (long n = 1; n <= std::lround(c.duration / c.step); ++n)
    all.push_back(static_cast<double>(n) * c.step);
  return all;
}

// First run: its error. Measuring is not timed.
void observe(Row& row, double budget) {
  row.engine->load(row.test->scene, row.scheme, row.h);
  const Judge judge = row.test->judge();
  std::vector<double> q, v;
  double spent = 0;
  for (const double t : measured_times(*row.test)) {
    const double start = thread_seconds();
    row.engine->advance(t);
    spent += thread_seconds() - start;
    row.engine->read(q, v);
    row.error = judge(t, q, v);
    if (!row.scheme.adaptive) row.steps = std::lround(t / row.h);
    if (!std::isfinite(row.error)) {
      row.stopped = "not a number after " + std::to_string(t) + " s";
      break;
    }
    if (spent > budget && t < row.test->duration - 1e-9) {
      row.stopped = "exceeded the budget after " + std::to_string(t) + " s of the scene";
      break;
    }
  }
  row.seconds.push_back(spent);
}

// Further runs: steps only, repeated for at least 2 ms.
void repeat(Row& row) {
  constexpr double kLongEnough = 2e-3;
  const std::vector<double> times =
      row.test->times.empty() ? std::vector{row.test->duration} : row.test->times;
  double spent = 0;
  int runs = 0;
  do {
    row.engine->load(row.test->scene, row.scheme, row.h);
    const double start = thread_seconds();
    for (const double t : times) row.engine->advance(t);
    spent += thread_seconds() - start;
    ++runs;
  } while (spent < kLongEnough);
  row.seconds.push_back(spent / runs);
}

std::string name_of(const Row& row) {
  return row.test->name + ", " + row.name + ' ' + row.scheme.name;
}

double expected_of_all(const Row& row, int repetitions) {
  return repetitions > 1 && row.expected < kOnceIsEnough ? row.expected * (1 + repetitions)
                                                         : row.expected;
}

// One run of each row for its error, then `repetitions` for its time; in each repetition all rows
// run one after the other, so that a temporary load of the machine affects all. A run that exceeds
// `budget` [s] is stopped.
void measure(std::vector<Row>& rows, int repetitions, double budget, Stages& stages) {
  const auto worth_repeating = [&](const Row& row) {
    return repetitions > 1 && row.stopped.empty() && row.seconds[0] < kOnceIsEnough;
  };
  std::vector<Row*> repeated;
  for (Row& row : rows) {
    stages.begin(name_of(row), row.expected);
    try {
      observe(row, budget);
    } catch (const std::exception& fault) {
      row.stopped = fault.what(), row.error = NAN;
    }
    if (worth_repeating(row)) repeated.push_back(&row);
    const double remaining = worth_repeating(row) ? repetitions * row.expected : 0;
    stages.skip(expected_of_all(row, repetitions) - row.expected - remaining);
  }
  for (Row* row : repeated) row->seconds.clear();  // with cold caches
  for (int n = 0; n < repetitions && repetitions > 1; ++n)
    for (Row* row : repeated) {
      stages.begin(name_of(*row) + ", again", row->expected);
      repeat(*row);
    }
}

using Json = nlohmann::ordered_json;  // numbers that are not finite become null

struct Options {
  Names cases, engines;  // empty: all
  bool work_precision = false;
  int repetitions = 3;
  double budget = 20;
};

// Each kind with its first variant, which runs scenes.
struct Peer {
  std::string name;
  std::unique_ptr<Engine> engine;
};
std::vector<Peer> all_peers() {
  std::vector<Peer> peers;
  for (const EngineKind& kind : kinds_in_order())
    peers.push_back({kind.name, std::move(kind.make().front())});
  std::erase_if(peers, [](const Peer& peer) { return peer.engine->schemes({}).empty(); });
  return peers;
}

std::vector<SceneCase> all_cases() {
  std::vector<SceneCase> all;
  for (auto* family : {&smooth_cases, &contact_cases, &engine_cases})
    for (SceneCase& c : family()) all.push_back(std::move(c));
  return all;
}

std::vector<Row> rows_of(const SceneCase& c, const std::vector<Peer>& peers,
                         const Options& options) {
  std::vector<Row> rows;
  // Estimate: 1 us per step and body, 10 us with contacts; 0.05 s for adaptive steps.
  const double step =
      (c.scene.floor ? 1e-5 : 1e-6) * static_cast<double>(c.scene.bodies.size());  // [s]
  for (const Peer& peer : peers) {
    if (!chosen(options.engines, peer.name) || !peer.engine->refusal(c.scene).empty()) continue;
    for (const Scheme& scheme : peer.engine->schemes(c.scene)) {
      const auto add = [&](double h) {
        const double expected =
            scheme.adaptive ? 0.05 : std::min(c.duration / h * step, options.budget);
        rows.push_back({peer.engine.get(), peer.name, &c, scheme, h, expected});
      };
      if (!options.work_precision) add(scheme.adaptive ? 1e-10 : c.step);
      for (int k = 0; options.work_precision && k < 9; ++k)
        add(scheme.adaptive ? std::pow(10.0, -3 - k) : std::ldexp(0.01, -k));
    }
  }
  return rows;
}

Json json_of(const Row& row) {
  const double median = median_of(row.seconds);
  return {{"case", row.test->name},
          {"group", row.test->group},
          {"engine", row.name},
          {"scheme", row.scheme.name},
          {"step", row.scheme.adaptive ? NAN : row.h},
          {"tolerance", row.scheme.adaptive ? row.h : NAN},
          {"error", row.error},
          {"unit", row.test->unit},
          {"seconds", median},
          {"spread", row.seconds.size() < 2 ? NAN : spread_of(row.seconds)},
          {"ns_per_step", row.steps > 0 ? 1e9 * median / static_cast<double>(row.steps) : NAN},
          {"stopped", row.stopped.empty() ? Json(nullptr) : Json(row.stopped)}};
}
Json json_of(const SceneCase& c) {
  Json published = Json::object();
  for (const auto& [who, error] : c.published) published[who] = error;
  return {{"name", c.name}, {"group", c.group},       {"what", c.what},
          {"unit", c.unit}, {"duration", c.duration}, {"published", published}};
}

int run(const Options& options) {
  const std::vector<Peer> peers = all_peers();
  std::vector<SceneCase> cases = all_cases();
  std::erase_if(cases, [&](const SceneCase& c) {
    return (options.work_precision && !c.work_precision) ||
           !(chosen(options.cases, c.name) || chosen(options.cases, c.group));
  });
  Json answer = {{"cases", Json::array()}, {"refused", Json::array()}};
  for (const SceneCase& c : cases) {
    answer["cases"].push_back(json_of(c));
    for (const Peer& peer : peers)
      if (const std::string why = peer.engine->refusal(c.scene); !why.empty())
        answer["refused"].push_back({{"case", c.name}, {"engine", peer.name}, {"why", why}});
  }
  answer["missing"] = missing_engines();
  for (const std::string& name : missing_engines())
    std::cerr << "bench_peers: " << name << " is not in this build: skipped\n";

  std::vector<std::vector<Row>> rows;  // by case
  double expected = 0;                 // [s]
  for (const SceneCase& c : cases) {
    rows.push_back(rows_of(c, peers, options));
    for (const Row& row : rows.back()) expected += expected_of_all(row, options.repetitions);
  }
  Stages stages("bench_peers", expected);
  Json& list = answer[options.work_precision ? "work_precision" : "rows"] = Json::array();
  for (auto& of_case : rows) {
    measure(of_case, options.repetitions, options.budget, stages);
    for (const Row& row : of_case) list.push_back(json_of(row));
  }
  std::cout << answer.dump(1) << '\n';
  return 0;
}

}  // namespace

}  // namespace twinarm::bench

int main(int argc, char** argv) {
  using namespace twinarm::bench;
  CLI::App program(
      "Runs the same scenes in all engines of this build; prints JSON on stdout, progress on "
      "stderr.",
      "bench_peers");
  Options o;
  std::set<std::string> cases;
  Names lines, engines = missing_engines();  // accepted, and reported as missing
  for (const SceneCase& c : all_cases()) {
    cases.insert({c.name, c.group});
    lines.push_back(c.name + "  " + c.group + "  " + c.what);
  }
  for (const EngineKind& kind : kinds_in_order()) {
    engines.push_back(kind.name);
    lines.push_back(kind.name);
  }
  add_names(program, "--cases", o.cases, "names or groups; default: all", cases);
  add_names(program, "--engines", o.engines, "default: all of this build", engines);
  program.add_flag("--work-precision", o.work_precision,
                   "many steps and tolerances instead of 1 ms, for the cases that support it");
  program.add_flag_callback(
      "--quick", [&] { o.repetitions = 1, o.budget = 0.2; }, "one repetition, budget 0.2 s");
  add_positive(program, "--repetitions", o.repetitions,
               "in each, all engines run one after the other");
  add_positive(program, "--budget", o.budget, "maximum CPU time of one run [s]");
  add_list(program, "prints the cases and the engines", lines);
  program.footer(
      "Example: bench_peers --cases C2,E2-slide --engines twinarm,mujoco\n"
      "Exit codes: 0 done; 2 bad option; 4 it failed.");
  return run_program(program, argc, argv, [&] { return run(o); });
}
