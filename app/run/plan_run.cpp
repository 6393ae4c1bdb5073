#include <fmt/format.h>

#include <cmath>

#include "app/run/simulate_options.h"
#include "app/support/nearest_name.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

constexpr double kMostSteps = 1e10, kMostSamples = 1e7;

bool is_positive(double value) {
  return value > 0 && std::isfinite(value);
}

std::vector<double> every(double interval, double duration) {
  std::vector<double> times;
  for (double n = 0; n * interval < duration * (1 - 1e-12); ++n) times.push_back(n * interval);
  times.push_back(duration);
  return times;
}

void check_times(const std::vector<double>& times, double duration, FaultList& faults) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    const std::string t = number_text(times[i]);
    if (times[i] < 0 || times[i] > duration)
      faults.add({"", 0, "--at",
                  t + " s is not within the run, from 0 to " + number_text(duration) + " s",
                  "give a longer --duration", "run.time"});
    else if (i > 0 && times[i] <= times[i - 1])
      faults.add({"", 0, "--at", t + " s comes after " + number_text(times[i - 1]) + " s",
                  "give each time once, in ascending order", "run.time-order"});
  }
}

void choose_integrator(const SimulateOptions& options, RunPlan& plan, FaultList& faults) {
  std::vector<std::string> names;
  for (const IntegratorFacts& facts : all_integrators) names.emplace_back(facts.name);
  if (const auto found = find_integrator(options.integrator))
    plan.integrator = *found;
  else if (!options.integrator.empty())
    faults.add({"", 0, "--integrator", "there is no '" + options.integrator + "'",
                name_remedy(options.integrator, names, "integrators"), "run.integrator"});
  if (!options.tolerance) return;
  plan.tolerance = *options.tolerance;
  if (!is_positive(plan.tolerance))
    faults.add({"", 0, "--tolerance", "must be positive, is " + number_text(plan.tolerance), "",
                "option.not-positive"});
  if (!plan.is_adaptive())
    faults.add({"", 0, "--tolerance",
                "'" + std::string(integrator_name(plan.integrator)) +
                    "' has steps of fixed size, and no tolerance",
                "give --step, or --integrator dopri5", "run.tolerance"});
}

}  // namespace

RunPlan plan_run(const SimulateOptions& options, const RunDefaults& defaults, FaultList& faults) {
  RunPlan plan;
  plan.integrator = defaults.integrator;
  plan.locates_events = defaults.locates_events;
  choose_integrator(options, plan, faults);
  const std::optional<double> duration = options.duration ? options.duration : defaults.duration;
  if (!duration)
    faults.add({"", 0, "--duration", "is missing", "give --duration SECONDS", "option.missing"});
  plan.duration = duration.value_or(1);
  plan.step_is_given = options.step.has_value();
  plan.step = options.step.value_or(plan.is_adaptive() ? plan.duration : defaults.step);
  const auto positive = [&](const char* option, double value) {
    if (!is_positive(value))
      faults.add({"", 0, option, "must be a positive number of seconds, is " + number_text(value),
                  "", "option.not-positive"});
    return is_positive(value);
  };
  const bool good_duration = positive("--duration", plan.duration);
  const bool good_step = !options.step || positive("--step", *options.step);
  if (good_step && good_duration && plan.duration / plan.step > kMostSteps)
    faults.add({"", 0, options.step ? "--step" : "step", "the run would have more than 1e10 steps",
                "give a longer step or a shorter duration", "run.too-many-steps"});
  if (options.record_every) positive("--record-every", *options.record_every);
  if (options.record_every && options.record.empty())
    faults.add(
        {"", 0, "--record-every", "nothing is recorded", "give --record FILE", "option.useless"});
  if (options.energy_bound) {
    plan.energy_bound = *options.energy_bound;
    if (!(plan.energy_bound > 0))
      faults.add(
          {"", 0, "--energy-bound",
           "must be a positive number of joules, or inf, is " + number_text(plan.energy_bound), "",
           "option.not-positive"});
  }
  if (options.json && options.csv)
    faults.add(
        {"", 0, "--csv", "stdout is taken by --json", "leave one of them out", "option.conflict"});
  if (options.every && !options.at.empty())
    faults.add({"", 0, "--every", "samples are asked for by --at already", "leave one of them out",
                "option.conflict"});

  plan.times = {0, plan.duration};
  if (!options.at.empty()) {
    plan.times = parse_list("--at", options.at, faults);
    if (good_duration) check_times(plan.times, plan.duration, faults);
  } else if (options.every && positive("--every", *options.every) && good_duration) {
    if (plan.duration / *options.every > kMostSamples)
      faults.add({"", 0, "--every", "there would be more than 1e7 samples", "give a longer time",
                  "run.too-many-samples"});
    else
      plan.times = every(*options.every, plan.duration);
  }
  return plan;
}

}  // namespace twinarm
