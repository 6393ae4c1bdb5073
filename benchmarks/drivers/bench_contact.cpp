// Time and contact quality of the engines on the same scenes with contacts. Prints JSON; the table
// is made by scripts/measure/bench.

#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "benchmarks/drivers/command_line.h"
#include "benchmarks/drivers/contact_measure.h"
#include "benchmarks/drivers/timing.h"

namespace twinarm::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr int steps_per_turn = 50;  // consecutive steps of one engine
constexpr int settling = 300;       // steps until the piles are at rest
constexpr double ns_per_s = 1e9;

constexpr int steps_per_look = 10;  // in heaps: between two measurements of contact quality
constexpr int quick_heap = 100;     // bodies at most with --quick

struct Options {
  Names models{timed_scene_names.begin(), timed_scene_names.end()};
  Names engines;  // empty: all
  double seconds = 30;
  bool quick = false;
  int repetitions() const { return quick ? 1 : 3; }
};

// An engine with one of its schemes.
struct Variant {
  std::unique_ptr<Engine> engine;
  Scheme scheme;
  std::string name;  // of the engine; with the scheme, unless it is the first one
};
bool has_contact_schemes(const Engine& engine) {
  return !engine.contact_schemes({}).empty();
}
std::vector<Variant> variants_of(const Options& options, const Scene& scene) {
  std::vector<Variant> variants;
  for (const auto& engine : engines_of_build(has_contact_schemes)) {
    const std::string name = engine->name();
    if (!chosen(options.engines, name)) continue;
    for (const Scheme& scheme : engine->contact_schemes(scene)) {
      Engines own = engines_of_build([&](const Engine& other) { return other.name() == name; });
      const bool first = variants.empty() || variants.back().engine->name() != name;
      variants.push_back(
          {std::move(own.front()), scheme, first ? name : name + ", " + scheme.name});
    }
  }
  return variants;
}
void start(const Variant& variant, const TimedScene& timed) {
  variant.engine->load(timed.scene, variant.scheme, timed.h);
}

// ---- scenes of a constant size ----

// Of one variant in one scene.
struct Row {
  std::string engine, model;
  std::vector<double> whole, rest;  // by repetition: mean time of a step [s]
  Json observed;                    // contact quality, and of the solver where known
};

// A separate run for the results, not timed.
Json observe(const Variant& variant, const TimedScene& timed) {
  start(variant, timed);
  Engine& engine = *variant.engine;
  ContactMeasure measure(timed);
  std::optional<SolverReading> solver;  // largest residual, mean times of a step
  int unconverged = 0;                  // steps
  std::vector<double> q, v;
  for (int step = 0; step < timed.steps; ++step) {
    if (const std::optional<SolverReading> now = engine.watched_step()) {
      if (!solver) solver.emplace();
      solver->residual = std::max(solver->residual, now->residual);
      solver->detection += now->detection / timed.steps;
      solver->solver += now->solver / timed.steps;
      solver->whole += now->whole / timed.steps;
      unconverged += now->converged ? 0 : 1;
    }
    engine.read(q, v);
    measure.measure(step, q);
  }
  Json json = {{"penetration", measure.penetration},
               {"largest_penetration", measure.max_penetration},
               {"drift", measure.drift}};
  if (solver) {
    json["residual"] = solver->residual;
    json["unconverged"] = unconverged;
    json["part_detection"] = solver->detection / solver->whole;
    json["part_solver"] = solver->solver / solver->whole;
  }
  return json;
}

void repeat(const std::vector<Variant>& variants, const TimedScene& timed, std::vector<Row>& rows) {
  std::vector<double> first(variants.size()), then(variants.size());
  for (const Variant& variant : variants) start(variant, timed);
  for (int step = 0; step < timed.steps; step += steps_per_turn)
    for (std::size_t i = 0; i < variants.size(); ++i) {
      const double start = thread_seconds();
      for (int k = 0; k < steps_per_turn; ++k) variants[i].engine->step();
      (step < settling ? first : then)[i] += thread_seconds() - start;
    }
  for (std::size_t i = 0; i < variants.size(); ++i) {
    rows[i].whole.push_back((first[i] + then[i]) / timed.steps);
    rows[i].rest.push_back(then[i] / std::max(1, timed.steps - settling));
  }
}

std::vector<Row> measure(const Options& options, const std::string& model, Stages& stages) {
  TimedScene timed = timed_scene(model);
  if (options.quick) timed.steps = steps_per_turn;
  const std::vector<Variant> variants = variants_of(options, timed.scene);
  std::vector<Row> rows(variants.size());
  const auto count = static_cast<double>(variants.size());
  for (std::size_t i = 0; i < variants.size(); ++i) {
    rows[i].engine = variants[i].name, rows[i].model = model;
    stages.begin(model + ", " + rows[i].engine + ": contact quality", 1.0 / count);
    rows[i].observed = observe(variants[i], timed);
  }
  for (int repetition = 0; repetition < options.repetitions(); ++repetition) {
    stages.begin(model + ", all engines in turns");
    repeat(variants, timed, rows);
  }
  return rows;
}

Json json_of(const Row& row) {
  Json json = {{"algorithm", "contact"},
               {"engine", row.engine},
               {"model", row.model},
               {"ns", ns_per_s * median_of(row.whole)},
               {"spread", spread_of(row.whole)},
               {"ns_rest", ns_per_s * median_of(row.rest)}};
  json.update(row.observed);
  return json;
}

// ---- heaps ----

struct HeapRun {
  Variant variant;
  ContactMeasure quality;
  std::vector<double> seconds{};  // by step
  double spent = 0, residual = NAN;
  int unconverged = 0;    // steps
  std::string stopped{};  // why the run is incomplete

  // The steps of a turn; stops at `limit` [s] of computing.
  void turn(const TimedScene& timed, double limit) try {
    if (seconds.empty()) start(variant, timed);
    std::vector<double> q, v;
    for (int k = 1; k <= steps_per_turn && stopped.empty(); ++k) {
      step();
      if (spent > limit) stopped = "time limit";
      if (k % steps_per_look != 0 && stopped.empty()) continue;
      variant.engine->read(q, v);
      if (std::ranges::all_of(q, [](double x) { return std::isfinite(x); }))
        quality.measure(static_cast<int>(seconds.size()), q);
      else
        stopped = "not a number";
    }
  } catch (const std::exception& fault) {
    stopped = fault.what();
  }
  void step() {
    const double start = thread_seconds();
    const std::optional<SolverReading> reading = variant.engine->watched_step();
    seconds.push_back(thread_seconds() - start);
    spent += seconds.back();
    if (!reading) return;
    residual = std::fmax(residual, reading->residual);
    unconverged += reading->converged ? 0 : 1;
  }
};

Json json_of(const HeapRun& run, const std::string& model) {
  Json json = {
      {"algorithm", "contact"},     {"engine", run.variant.name},  {"model", model},
      {"bodies", heap_size(model)}, {"steps", run.seconds.size()}, {"stopped", run.stopped}};
  if (run.seconds.empty()) return json;
  const auto late = run.seconds.end() - std::max<std::ptrdiff_t>(1, std::ssize(run.seconds) / 4);
  const auto mean_ns = [&](auto from) {
    return ns_per_s * std::reduce(from, run.seconds.end()) /
           static_cast<double>(run.seconds.end() - from);
  };
  json.update({{"ns", mean_ns(run.seconds.begin())},
               {"median_ns", ns_per_s * median_of(run.seconds)},
               {"worst_ns", ns_per_s * std::ranges::max(run.seconds)},
               {"ns_rest", mean_ns(late)},
               {"penetration", run.quality.penetration},
               {"largest_penetration", run.quality.max_penetration},
               {"escaped", run.quality.escaped()}});
  if (!std::isnan(run.residual))
    json.update({{"residual", run.residual}, {"unconverged", run.unconverged}});
  return json;
}

// One run of each variant, in turns. `slow`: variants and forms of which a smaller heap was
// stopped; they are omitted.
Json measure_heap(const Options& options, const std::string& model, std::set<std::string>& slow) {
  TimedScene timed = timed_scene(model);
  if (options.quick) timed.steps = steps_per_turn;
  const auto key = [&](const Variant& v) { return model.substr(0, 5) + v.name; };
  std::vector<HeapRun> runs;
  for (Variant& variant : variants_of(options, timed.scene))
    if (!slow.contains(key(variant)))
      runs.push_back(HeapRun{std::move(variant), ContactMeasure(timed)});
  for (int step = 0; step < timed.steps; step += steps_per_turn)
    for (HeapRun& run : runs) run.turn(timed, options.seconds);
  Json rows = Json::array();
  for (const HeapRun& run : runs) {
    rows.push_back(json_of(run, model));
    if (!run.stopped.empty()) slow.insert(key(run.variant));
  }
  return rows;
}

int run(const Options& options) {
  const double weight = 1 + options.repetitions();
  Stages stages("bench_contact", static_cast<double>(options.models.size()) * weight);
  Json rows = Json::array();
  std::set<std::string> slow;
  for (const std::string& model : options.models)
    if (heap_size(model) == 0) {
      for (const Row& row : measure(options, model, stages)) rows.push_back(json_of(row));
    } else if (!options.quick || heap_size(model) <= quick_heap) {
      stages.begin(model + ", all engines in turns", weight);
      for (const Json& row : measure_heap(options, model, slow)) rows.push_back(row);
    }
  std::cout << Json{{"rows", rows}}.dump(1) << '\n';
  return 0;
}

}  // namespace

}  // namespace twinarm::bench

int main(int argc, char** argv) {
  using namespace twinarm::bench;
  CLI::App program(
      "Times rigid-body engines on scenes with contacts; prints JSON on stdout, progress on "
      "stderr.",
      "bench_contact");
  Options o;
  add_names(program, "--models", o.models, "default: all", o.models);
  const Names engines = names_of(engines_of_build(has_contact_schemes));
  add_names(program, "--engines", o.engines, "default: all of this build", engines);
  add_positive(
      program, "--seconds", o.seconds,
      "CPU time of an engine in a heap [s]; beyond it the run is stopped, and larger heaps "
      "are omitted");
  program.add_flag("--quick", o.quick,
                   "one repetition of the first 50 steps; heaps of at most 100 bodies");
  add_list(program, "prints the engines", engines);
  program.footer(
      "Example: bench_contact --models pyr55 --engines \"twinarm double,bullet\"\n"
      "Exit codes: 0 done; 2 bad option; 4 it failed.");
  return run_program(program, argc, argv, [&] { return run(o); });
}
