// How long the engines take for the same mechanisms in the same situations. Prints JSON; the table
// and the figure are scripts/bench's.
#include <algorithm>
#include <iostream>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "benchmarks/speed/agreement.h"
#include "benchmarks/speed/engine.h"
#include "benchmarks/speed/options.h"
#include "benchmarks/speed/stages.h"
#include "benchmarks/speed/timing.h"

namespace twinarm::speed {
namespace {

constexpr const char* usage =
    R"(Times rigid-body engines on the same mechanisms; prints JSON on stdout, progress on stderr.

  bench_speed [--models A,B] [--engines A,B] [--algorithms fd,id,crba,fk,step]
              [--repetitions N] [--seconds S] [--quick] [--list]

  --models       scara3, puma6, humanoid30, chainN; default: the six of the published table
  --engines      default: all of this build (--list prints their names)
  --repetitions  default 9; each runs all engines one after the other
  --seconds      of each engine in each repetition, default 0.02
  --quick        3 repetitions of 0.003 s: to see that it runs

Example: bench_speed --models puma6,chain32 --algorithms fd
Exit codes: 0 done; 1 an engine's answers differ from twinarm's (its rows are left out); 2 bad option.
)";

struct Options {
  std::vector<std::string> models = {"scara3",  "puma6",    "chain7",
                                     "chain32", "chain128", "humanoid30"};
  std::vector<std::string> engines, algorithms;  // empty: all
  int repetitions = 9;
  double seconds = 0.02;
  bool list = false, help = false;
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
    else if (name == "--algorithms")
      o.algorithms = split(value());
    else if (name == "--repetitions")
      o.repetitions = positive<int>(value());
    else if (name == "--seconds")
      o.seconds = positive<double>(value());
    else if (name == "--quick")
      o.repetitions = 3, o.seconds = 0.003;
    else if (name == "--list")
      o.list = true;
    else if (name == "--help" || name == "-h")
      o.help = true;
    else
      throw std::invalid_argument("unknown option " + name);
  }
  for (const std::string& model : o.models) mechanism(model);
  for (const std::string& wanted : o.algorithms)
    if (std::ranges::find(algorithms, wanted, &NamedAlgorithm::name) == algorithms.end())
      throw std::invalid_argument("no algorithm " + wanted + ": there are fd, id, crba, fk, step");
  const Engines all = all_engines();
  for (const std::string& wanted : o.engines)
    if (std::ranges::none_of(all, [&](const auto& engine) { return engine->name() == wanted; }))
      throw std::invalid_argument("no engine " + wanted + " in this build; see --list");
  return o;
}

bool chosen(const std::vector<std::string>& list, std::string_view name) {
  return list.empty() || std::ranges::find(list, name) != list.end();
}

struct Row {
  std::string algorithm, engine, model;
  Timing timing;
};
struct Results {
  std::vector<Row> rows;
  std::vector<Agreement> agreement;
};

Engines engines_for(const Mechanism& mechanism, const std::vector<Situation>& situations) {
  Engines engines = all_engines();
  for (const auto& engine : engines) {
    engine->load(mechanism);
    engine->set_situations(situations);
  }
  return engines;
}

void measure(const Options& options, const std::string& model, Stages& stages, Results& results) {
  const Mechanism mechanism = speed::mechanism(model);
  const auto given = situations(mechanism, mechanism.nv() > 200 ? 16 : 64);
  Engines engines = engines_for(mechanism, given);
  for (std::size_t i = engines.size(); i-- > 1;)
    if (!chosen(options.engines, engines[i]->name()))
      engines.erase(engines.begin() + static_cast<std::ptrdiff_t>(i));

  const std::vector<Agreement> agreement = compare(engines, mechanism, given);
  results.agreement.insert(results.agreement.end(), agreement.begin(), agreement.end());
  for (const Agreement& a : agreement)
    if (!a.holds())
      std::cerr << "bench_speed: " << a.engine << " computes another " << model
                << ": qdd differs by " << a.error << ", tau by " << a.error_inverse
                << " (relative), allowed is " << a.tolerance << "; it is left out\n";

  for (const auto& [algorithm, name] : algorithms) {
    if (!chosen(options.algorithms, name)) continue;
    std::vector<std::function<void()>> jobs;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < engines.size(); ++i) {
      Engine* engine = engines[i].get();
      if (!agreement[i].holds() || !engine->has(algorithm)) continue;
      if (!chosen(options.engines, engine->name())) continue;
      jobs.push_back([engine, which = algorithm] { engine->run(which); });
      names.push_back(engine->name());
    }
    stages.begin(std::string(name) + " of " + model + ", " + std::to_string(jobs.size()) +
                 " engines");
    std::vector<Timing> timings = time_interleaved(jobs, options.repetitions, options.seconds);
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      timings[i].ns /= static_cast<double>(given.size());
      results.rows.push_back({std::string(name), names[i], model, timings[i]});
    }
  }
}

std::string json(const Results& results) {
  std::ostringstream out;
  out.precision(17);
  out << "{\"rows\": [";
  const char* separator = "\n  ";
  for (const Row& row : results.rows) {
    out << separator << "{\"algorithm\": \"" << row.algorithm << "\", \"engine\": \"" << row.engine
        << "\", \"model\": \"" << row.model << "\", \"ns\": " << row.timing.ns
        << ", \"spread\": " << row.timing.spread << "}";
    separator = ",\n  ";
  }
  out << "],\n \"agreement\": [";
  separator = "\n  ";
  for (const Agreement& a : results.agreement) {
    // JSON has no infinity
    const auto number = [](double x) { return x <= 1e300 ? x : 1e300; };
    out << separator << "{\"engine\": \"" << a.engine << "\", \"model\": \"" << a.model
        << "\", \"error\": " << number(a.error)
        << ", \"error_inverse\": " << number(a.error_inverse) << ", \"tolerance\": " << a.tolerance
        << ", \"pass\": " << (a.holds() ? "true" : "false") << "}";
    separator = ",\n  ";
  }
  out << "]}\n";
  return out.str();
}

int run(const Options& options) {
  if (options.help) {
    std::cout << usage;
    return 0;
  }
  if (options.list) {
    for (const auto& engine : all_engines()) std::cout << engine->name() << '\n';
    return 0;
  }
  Results results;
  const auto of_a_model = std::ranges::count_if(
      algorithms, [&](const auto& each) { return chosen(options.algorithms, each.name); });
  Stages stages("bench_speed",
                static_cast<double>(options.models.size()) * static_cast<double>(of_a_model));
  for (const std::string& model : options.models) measure(options, model, stages, results);
  std::cout << json(results);
  return std::ranges::all_of(results.agreement, &Agreement::holds) ? 0 : 1;
}

}  // namespace
}  // namespace twinarm::speed

int main(int argc, char** argv) {
  std::optional<twinarm::speed::Options> options;
  try {
    options = twinarm::speed::options_from(argc, argv);
  } catch (const std::exception& fault) {
    std::cerr << "bench_speed: " << fault.what() << "; see --help\n";
    return 2;
  }
  try {
    return twinarm::speed::run(*options);
  } catch (const std::exception& fault) {
    std::cerr << "bench_speed: " << fault.what() << '\n';
    return 4;
  }
}
