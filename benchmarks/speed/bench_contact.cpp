// How long the engines take for the same scenes with contacts, and how well they hold them. Prints
// JSON; the table is scripts/bench's.
#include <algorithm>
#include <iostream>
#include <optional>
#include <stdexcept>

#include "benchmarks/speed/contact_engine.h"
#include "benchmarks/speed/options.h"
#include "benchmarks/speed/stages.h"

namespace twinarm::speed {
namespace {

constexpr const char* usage =
    R"(Times rigid-body engines on scenes with contacts; prints JSON on stdout, progress on stderr.

  bench_contact [--models wall100,pyr55,scara] [--engines A,B] [--repetitions N] [--quick] [--list]

  --models       default: all three
  --engines      default: all of this build (--list prints their names)
  --repetitions  of the whole run, default 3; engines take turns every 50 steps
  --quick        one repetition of the first 50 steps: to see that it runs

Example: bench_contact --models pyr55 --engines "twinarm double,bullet"
Exit codes: 0 done; 2 bad option.
)";

constexpr int steps_of_a_turn = 50;  // steps of one engine, before the next one's turn
constexpr int settling = 300;        // steps; from then on the piles are at rest
constexpr double ns_per_s = 1e9;

struct Options {
  std::vector<std::string> models{contact_scene_names.begin(), contact_scene_names.end()};
  std::vector<std::string> engines;  // empty: all
  int repetitions = 3;
  bool quick = false, list = false, help = false;
};

Options options_from(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    const auto value = [&]() -> std::string {
      if (i + 1 >= argc) throw std::invalid_argument(name + " needs a value");
      return argv[++i];
    };
    if (name == "--models")
      o.models = split(value());
    else if (name == "--engines")
      o.engines = split(value());
    else if (name == "--repetitions")
      o.repetitions = positive<int>(value());
    else if (name == "--quick")
      o.quick = true, o.repetitions = 1;
    else if (name == "--list")
      o.list = true;
    else if (name == "--help" || name == "-h")
      o.help = true;
    else
      throw std::invalid_argument("unknown option " + name);
  }
  for (const std::string& model : o.models) contact_scene(model);
  const ContactEngines all = all_contact_engines();
  for (const std::string& wanted : o.engines)
    if (std::ranges::none_of(all, [&](const auto& engine) { return engine->name() == wanted; }))
      throw std::invalid_argument("no engine " + wanted + " in this build; see --list");
  return o;
}

// Of one engine in one scene.
struct Row {
  std::string engine, model;
  std::vector<double> whole, settling, rest;  // by repetition: mean time of a step [s]
  double penetration = 0, largest_penetration = 0, drift = 0;
  std::optional<SolverReading> solver;  // residual the largest, times the means of all steps
  int unconverged = 0;                  // steps
};

// A run of its own for what it comes to: looking at it is not timed.
void observe(ContactEngine& engine, const ContactScene& scene, Row& row) {
  engine.load(scene);
  ContactMeasure measure(scene);
  for (int step = 0; step < scene.steps; ++step) {
    if (const std::optional<SolverReading> now = engine.watched_step()) {
      if (!row.solver) row.solver.emplace();
      row.solver->residual = std::max(row.solver->residual, now->residual);
      row.solver->detection += now->detection / scene.steps;
      row.solver->solver += now->solver / scene.steps;
      row.solver->whole += now->whole / scene.steps;
      row.unconverged += now->converged ? 0 : 1;
    }
    measure.take(step, engine.bodies());
  }
  row.penetration = measure.penetration();
  row.largest_penetration = measure.largest_penetration();
  row.drift = measure.drift();
}

void repeat(ContactEngines& engines, const ContactScene& scene, std::vector<Row>& rows) {
  std::vector<double> first(engines.size()), then(engines.size());
  for (const auto& engine : engines) engine->load(scene);
  for (int step = 0; step < scene.steps; step += steps_of_a_turn)
    for (std::size_t i = 0; i < engines.size(); ++i) {
      const double start = thread_seconds();
      for (int k = 0; k < steps_of_a_turn; ++k) engines[i]->step();
      (step < settling ? first : then)[i] += thread_seconds() - start;
    }
  const int early = std::min(settling, scene.steps);
  for (std::size_t i = 0; i < engines.size(); ++i) {
    rows[i].whole.push_back((first[i] + then[i]) / scene.steps);
    rows[i].settling.push_back(first[i] / early);
    rows[i].rest.push_back(then[i] / std::max(1, scene.steps - early));
  }
}

std::vector<Row> measure(const Options& options, const std::string& model, Stages& stages) {
  ContactScene scene = contact_scene(model);
  if (options.quick) scene.steps = steps_of_a_turn;
  ContactEngines engines = all_contact_engines();
  std::erase_if(engines, [&](const auto& engine) {
    return !options.engines.empty() &&
           std::ranges::find(options.engines, engine->name()) == options.engines.end();
  });
  std::vector<Row> rows(engines.size());
  const auto count = static_cast<double>(engines.size());
  for (std::size_t i = 0; i < engines.size(); ++i) {
    rows[i].engine = engines[i]->name(), rows[i].model = model;
    stages.begin(model + ", " + rows[i].engine + ": how it holds", 1.0 / count);
    observe(*engines[i], scene, rows[i]);
  }
  for (int repetition = 0; repetition < options.repetitions; ++repetition) {
    stages.begin(model + ", all engines in turns");
    repeat(engines, scene, rows);
  }
  return rows;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

void print(const Row& row) {
  const double ns = ns_per_s * median(row.whole);
  const auto [least, most] = std::ranges::minmax(row.whole);
  std::cout << "{\"algorithm\": \"contact\", \"engine\": \"" << row.engine << "\", \"model\": \""
            << row.model << "\", \"ns\": " << ns
            << ", \"spread\": " << ns_per_s * (most - least) / ns
            << ", \"ns_settling\": " << ns_per_s * median(row.settling)
            << ", \"ns_rest\": " << ns_per_s * median(row.rest)
            << ", \"penetration\": " << row.penetration
            << ", \"largest_penetration\": " << row.largest_penetration
            << ", \"drift\": " << row.drift;
  if (const auto& s = row.solver)
    std::cout << ", \"residual\": " << s->residual << ", \"unconverged\": " << row.unconverged
              << ", \"part_detection\": " << s->detection / s->whole
              << ", \"part_solver\": " << s->solver / s->whole;
  std::cout << '}';
}

int run(const Options& options) {
  if (options.help) {
    std::cout << usage;
    return 0;
  }
  if (options.list) {
    for (const auto& engine : all_contact_engines()) std::cout << engine->name() << '\n';
    return 0;
  }
  std::cout.precision(17);
  std::cout << "{\"rows\": [";
  const char* separator = "\n  ";
  Stages stages("bench_contact",
                static_cast<double>(options.models.size()) * (1 + options.repetitions));
  for (const std::string& model : options.models)
    for (const Row& row : measure(options, model, stages)) {
      std::cout << separator;
      print(row);
      separator = ",\n  ";
    }
  std::cout << "]}\n";
  return 0;
}

}  // namespace
}  // namespace twinarm::speed

int main(int argc, char** argv) {
  std::optional<twinarm::speed::Options> options;
  try {
    options = twinarm::speed::options_from(argc, argv);
  } catch (const std::exception& fault) {
    std::cerr << "bench_contact: " << fault.what() << "; see --help\n";
    return 2;
  }
  try {
    return twinarm::speed::run(*options);
  } catch (const std::exception& fault) {
    std::cerr << "bench_contact: " << fault.what() << '\n';
    return 4;
  }
}
