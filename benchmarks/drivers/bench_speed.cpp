// Time of the engines on the same mechanisms in the same situations. Prints JSON; table and figure
// are made by scripts/measure/bench.
#include <dlfcn.h>

#include <nlohmann/json.hpp>

#include "benchmarks/drivers/command_line.h"
#include "benchmarks/drivers/timing.h"
#include "benchmarks/scenes/mechanisms.h"

namespace twinarm::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::pair<Algorithm, const char*> algorithms[] = {
    {Algorithm::forward_dynamics, "fd"}, {Algorithm::inverse_dynamics, "id"},
    {Algorithm::mass_matrix, "crba"},    {Algorithm::kinematics, "fk"},
    {Algorithm::step, "step"},           {Algorithm::inverse_mass_matrix, "minv"},
    {Algorithm::derivatives, "dfd"},     {Algorithm::constrained_dynamics, "loop"}};

struct Options {
  Names models = {"scara3", "puma6", "chain7", "chain32", "chain128", "humanoid30"};
  Names engines, algorithms;  // empty: all
  Names peers;                // shared libraries (benchmarks/peers/)
  int repetitions = 9;
  double seconds = 0.02;
};

bool is_timed(const Engine& engine) {
  return engine.has(Algorithm::forward_dynamics);
}

// Why there is no such model; empty if there is.
std::string fault_of_model(const std::string& name) {
  try {
    mechanism(name);
  } catch (const std::invalid_argument& fault) {
    return fault.what();
  }
  return {};
}

Engines timed_engines(const Names& peers) {
  Engines engines = engines_of_build(is_timed);
  for (const std::string& path : peers) {
    void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* const add = library ? dlsym(library, "add_engines") : nullptr;
    if (!add) throw std::runtime_error("cannot open " + path + ": " + dlerror());
    reinterpret_cast<void (*)(Engines&)>(add)(engines);
  }
  return engines;
}

// ---- agreement of the results ----

struct Agreement {
  std::string engine, model;
  double error = 0;              // of qdd, against the first engine, relative to its largest entry
  double error_inverse = 0;      // of the joint torques by inverse dynamics, likewise; 0 without it
  double error_constrained = 0;  // of qdd with a body held in place, likewise
  double tolerance = 0, constrained_tolerance = 0;
  bool holds() const { return error <= tolerance && error_inverse <= tolerance; }
  bool holds_constrained() const { return error_constrained <= constrained_tolerance; }
};

using Results = std::vector<std::vector<double>>;  // by situation

double relative_error(const Results& mine, const Results& reference) {
  double worst = 0;
  for (std::size_t k = 0; k < reference.size(); ++k) {
    const auto n = static_cast<Eigen::Index>(reference[k].size());
    const Eigen::Map<const Eigen::VectorXd> exact(reference[k].data(), n), given(mine[k].data(), n);
    if (mine[k].size() != reference[k].size() || !(given - exact).allFinite()) return HUGE_VAL;
    const double size = exact.lpNorm<Eigen::Infinity>();
    worst = std::max(worst, (given - exact).lpNorm<Eigen::Infinity>() / (size > 0 ? size : 1));
  }
  return worst;
}

// Largest error over all situations of every engine, against the first. The engines are loaded.
std::vector<Agreement> compare(Engines& engines, const std::string& model, const Scene& mechanism,
                               const std::vector<Situation>& situations) {
  std::vector<Agreement> all;
  Results first_qdd, first_tau, first_constrained;
  for (const auto& engine : engines) {
    Results qdd, tau, constrained;
    for (std::size_t k = 0; k < situations.size(); ++k) {
      qdd.push_back(engine->qdd(k));
      if (engine->has(Algorithm::constrained_dynamics))
        constrained.push_back(engine->constrained_qdd(k));
      if (!engine->has(Algorithm::inverse_dynamics)) continue;
      const std::vector<double> forces = engine->tau(k);
      tau.emplace_back(forces.begin() + (mechanism.floats() ? 6 : 0), forces.end());  // of joints
    }
    if (first_qdd.empty()) first_qdd = qdd, first_tau = tau, first_constrained = constrained;
    all.push_back({engine->name(), model, relative_error(qdd, first_qdd),
                   tau.empty() ? 0 : relative_error(tau, first_tau),
                   constrained.empty() ? 0 : relative_error(constrained, first_constrained),
                   engine->tolerance(mechanism), engine->constrained_tolerance()});
  }
  return all;
}

// ---- times ----

void measure(const Options& options, const std::string& model, Stages& stages, Json& rows,
             std::vector<Agreement>& agreement) {
  const Scene mechanism = bench::mechanism(model);
  const auto given = situations(mechanism, mechanism.bodies.size() > 200 ? 16 : 64);
  Engines engines = timed_engines(options.peers);
  std::erase_if(engines, [&](const auto& engine) {  // but the first one, the reference
    return &engine != engines.data() &&
           (!chosen(options.engines, engine->name()) || !engine->refusal(mechanism).empty());
  });
  for (const auto& engine : engines) {
    engine->load_mechanism(mechanism);
    engine->set_situations(given);
  }
  const std::vector<Agreement> agreed = compare(engines, model, mechanism, given);
  for (const Agreement& a : agreed) {
    agreement.push_back(a);
    if (!a.holds())
      std::cerr << "bench_speed: " << a.engine << " disagrees on " << model
                << ": relative error of qdd " << a.error << ", of tau " << a.error_inverse
                << ", allowed " << a.tolerance << "; it is omitted\n";
    else if (!a.holds_constrained())  // of a planar arm the constraint is redundant
      std::cerr << "bench_speed: " << a.engine << " disagrees on " << model
                << " with a body held: relative error of qdd " << a.error_constrained
                << ", allowed " << a.constrained_tolerance << "; omitted there\n";
  }

  for (const auto& [algorithm, name] : algorithms) {
    if (!chosen(options.algorithms, name)) continue;
    std::vector<std::function<void()>> jobs;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < engines.size(); ++i) {
      Engine* engine = engines[i].get();
      if (!agreed[i].holds() || !engine->has(algorithm)) continue;
      if (algorithm == Algorithm::constrained_dynamics && !agreed[i].holds_constrained()) continue;
      if (!chosen(options.engines, engine->name())) continue;
      jobs.push_back([engine, which = algorithm] { engine->run(which); });
      names.push_back(engine->name());
    }
    stages.begin(std::string(name) + " of " + model + ", " + std::to_string(jobs.size()) +
                 " engines");
    const std::vector<Timing> timings =
        time_interleaved(jobs, options.repetitions, options.seconds);
    for (std::size_t i = 0; i < jobs.size(); ++i)
      rows.push_back({{"algorithm", name},
                      {"engine", names[i]},
                      {"model", model},
                      {"ns", timings[i].ns / static_cast<double>(given.size())},
                      {"spread", timings[i].spread}});
  }
}

Json json_of(const Agreement& a) {
  constexpr double kMax = 1e300;  // JSON has no infinity
  return {{"engine", a.engine},
          {"model", a.model},
          {"error", std::min(kMax, a.error)},
          {"error_inverse", std::min(kMax, a.error_inverse)},
          {"error_constrained", std::min(kMax, a.error_constrained)},
          {"tolerance", a.tolerance},
          {"pass", a.holds()}};
}

int run(const Options& options) {
  const auto of_a_model = std::ranges::count_if(
      algorithms, [&](const auto& each) { return chosen(options.algorithms, each.second); });
  Stages stages("bench_speed",
                static_cast<double>(options.models.size()) * static_cast<double>(of_a_model));
  Json result = {{"rows", Json::array()}, {"agreement", Json::array()}};
  std::vector<Agreement> agreement;
  for (const std::string& model : options.models)
    measure(options, model, stages, result["rows"], agreement);
  for (const Agreement& a : agreement) result["agreement"].push_back(json_of(a));
  std::cout << result.dump(1) << '\n';
  return std::ranges::all_of(agreement, &Agreement::holds) ? 0 : 1;
}

}  // namespace
}  // namespace twinarm::bench

int main(int argc, char** argv) {
  using namespace twinarm::bench;
  CLI::App program(
      "Times rigid-body engines on the same mechanisms; prints JSON on stdout, progress on stderr.",
      "bench_speed");
  Options o;
  program
      .add_option("--models", o.models,
                  "scara3, puma6, humanoid30, chainN; default: the six of the published table")
      ->delimiter(',')
      ->check(fault_of_model);
  const Names engines = names_of(engines_of_build(is_timed));
  program.add_option("--engines", o.engines, "default: all of this build and of --peers")
      ->delimiter(',');
  add_names(program, "--algorithms", o.algorithms, "default: all",
            Names{"fd", "id", "crba", "fk", "step", "minv", "dfd", "loop"});
  program.add_option("--peers", o.peers, "also the engines of these shared libraries")
      ->delimiter(',')
      ->check(CLI::ExistingFile);
  program.add_flag_callback(
      "--quick", [&] { o.repetitions = 3, o.seconds = 0.003; }, "3 repetitions of 0.003 s");
  add_positive(program, "--repetitions", o.repetitions,
               "each runs all engines one after the other");
  add_positive(program, "--seconds", o.seconds, "of each engine in each repetition");
  add_list(program, "prints the engines", engines);
  program.footer(
      "Example: bench_speed --models puma6,chain32 --algorithms fd\n"
      "Exit codes: 0 done; 1 results of an engine differ from twinarm's (its rows are omitted); "
      "2 bad option; 4 it failed.");
  return run_program(program, argc, argv, [&] { return run(o); });
}
