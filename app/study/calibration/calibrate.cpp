#include "app/study/calibration/calibration.h"

#include <fmt/format.h>

#include "app/support/parallel_for.h"

namespace twinarm {
namespace {

constexpr unsigned kSeed = 1;
constexpr int kFitEvaluations = 4000, kTrialEvaluations = 700;
// Change of a gain for the sensitivity of a fit; the folded law is sensitive to its gains.
constexpr double kGainChange = 1.005;
constexpr double kMinFrequency = 1;  // [Hz]; without it a pure damper would be optimal
// Gains by trial are this far within their stability limit: those with 1 % more are stable too.
constexpr double kStepMargin = 1.02;

using Objective = std::function<double(const CalibrationEntry&)>;
struct Job {
  CalibrationEntry entry;
  Method method = Method::multistart;
  int evaluations = 0;
  Objective objective;
  // If not empty: the search is repeated among the entries for which this holds, unless its result
  // is one of them; the numbers keep the gains of the first search if they are better.
  std::function<bool(const CalibrationEntry&)> allowed;
  std::function<void(CalibrationEntry&)> finish;  // writes the numbers of the entry
};

// Bounds of one k and one b: from a natural frequency of kMinFrequency to the stability limit of
// the semi-implicit step, at the start pose.
std::vector<Parameter> bounds(const StudyRobot& robot, const RunSpec& spec, double ratio) {
  RunResult unit;
  unit.spec = spec;
  unit.spec.gains = {1, 0, ratio, 0};
  predict(robot, unit, robot.start_state());
  const double h = spec.step(), slow = unit.frequency[0], fast = unit.frequency[1];
  const double k_low = std::pow(2 * std::numbers::pi * kMinFrequency / slow, 2);
  const double k_high = 4 / std::pow(h * fast, 2), b_high = 2 / (h * fast * fast);
  return {{"k", std::min(k_low, 0.1 * k_high), k_high, 0}, {"b", 1e-4 * b_high, b_high, 0}};
}

using SharedRobot = std::shared_ptr<const StudyRobot>;
SharedRobot shared_s103(const StudyInputs& inputs, double arm2_mass_scale) {
  return std::make_shared<StudyRobot>(
      StudyRobot::s103(inputs.settings, inputs.s103, arm2_mass_scale));
}

// Worst error when one gain of all springs changes by kGainChange.
double sensitive_error(const StudyRobot& robot, RunSpec spec) {
  const AutomaticMotion hand{OperatorMapping{}};
  const Gains g = spec.gains;
  double worst = 0;
  for (double factor : {kGainChange, 1 / kGainChange}) {
    spec.gains = {g.k1 * factor, g.b1, g.k2 * factor, g.b2};
    worst = std::max(worst, worst_relative_error(run(robot, hand, spec)));
    spec.gains = {g.k1, g.b1 * factor, g.k2, g.b2 * factor};
    worst = std::max(worst, worst_relative_error(run(robot, hand, spec)));
  }
  return worst;
}

// Fit to the row of the paper that the specification names. `robot`: of the parameters.
Job fit_job(const std::string& name, std::vector<Parameter> parameters, const RunSpec& spec,
            const std::function<SharedRobot(const CalibrationEntry&)>& robot) {
  Job job;
  job.entry.name = name;
  job.entry.rate = spec.rate;
  job.entry.parameters = std::move(parameters);
  job.evaluations = kFitEvaluations;
  const auto result_of = [=](const CalibrationEntry& entry) {
    const AutomaticMotion hand{OperatorMapping{}};
    return run(*robot(entry), hand, spec.with_gains(entry.gains()));
  };
  job.objective = [=](const CalibrationEntry& entry) {
    return worst_relative_error(result_of(entry));
  };
  job.finish = [=](CalibrationEntry& entry) {
    const RunResult result = result_of(entry);
    entry.keep(result.max_deg, result.mean_deg);
    entry.numbers["worst_error"] = worst_relative_error(result);
    entry.numbers["worst_error_shifted"] = sensitive_error(*robot(entry), result.spec);
  };
  return job;
}

Job e3_job(const StudyInputs& inputs, const std::string& law, double rate) {
  Job job = fit_job(fmt::format("E3/{:g}/{}", rate, law),
                    {{"k", 10, 3000, 0}, {"b", 0.02, 50, 0}, {"arm2_mass_scale", 0.2, 4, 0}},
                    e3_spec(law, rate), [&inputs](const CalibrationEntry& entry) {
                      return shared_s103(inputs, entry.value("arm2_mass_scale"));
                    });
  job.method = Method::rugged;
  return job;
}

Job e4_job(const StudyInputs& inputs, double rate, double arm2_mass_scale) {
  Job job = fit_job(
      fmt::format("E4/{:g}", rate),
      {{"k1", 10, 1e6, 0}, {"b1", 0.1, 1e4, 0}, {"k2", 10, 1e6, 0}, {"b2", 0.1, 1e4, 0}},
      e4_spec(rate),
      [robot = shared_s103(inputs, arm2_mass_scale)](const CalibrationEntry&) { return robot; });
  job.entry.numbers["arm2_mass_scale"] = arm2_mass_scale;
  return job;
}

// One k and b with the minimum objective of the protocol, stable at every pose of the motion. Keeps
// a reference to the robot.
Job trial_job(const std::string& name, const RunSpec& spec, const StudyRobot& robot,
              const std::vector<double>& sweep_times) {
  Job job;
  job.entry.name = name;
  job.entry.rate = spec.rate;
  const double ratio = name.find("ratio") != std::string::npos ? 0.2 : 1;  // k2/k1 and b2/b1
  if (ratio != 1) job.entry.numbers["ratio"] = ratio;
  job.entry.parameters = bounds(robot, spec, ratio);
  const bool folds = spec.coupling.printed && spec.coupling.type == CouplingSpec::Type::torsional &&
                     spec.coupling.options.damper != Damper::vector_;
  if (folds) job.method = Method::rugged;
  job.evaluations = folds ? 2 * kTrialEvaluations : kTrialEvaluations;
  const auto errors = [=, &robot](const CalibrationEntry& entry) {
    return run_protocol(robot, spec.with_gains(entry.gains()), sweep_times);
  };
  job.objective = [=](const CalibrationEntry& entry) { return errors(entry).objective; };
  job.allowed = [=, &robot](const CalibrationEntry& entry) {
    return kStepMargin / spec.rate <= step_limit_of_motion(robot, spec.with_gains(entry.gains()));
  };
  job.finish = [=](CalibrationEntry& entry) {
    const ProtocolErrors e = errors(entry);
    entry.keep(e.max_deg, e.mean_deg);
  };
  return job;
}

constexpr unsigned kWorkers = 2;

void run(Job& job) {
  const CalibrationEntry start = job.entry;
  minimise(job.entry, job.method, kSeed, job.evaluations, job.objective);
  if (job.allowed && !job.allowed(job.entry)) {
    const CalibrationEntry best = std::exchange(job.entry, start);
    minimise(job.entry, job.method, kSeed, job.evaluations, [&](const CalibrationEntry& entry) {
      return job.allowed(entry) ? job.objective(entry) : kUnstable;
    });
    if (best.objective < job.entry.objective)
      job.entry.numbers.insert({{"unstable_k", best.value("k")}, {"unstable_b", best.value("b")}});
  }
  job.finish(job.entry);
}

// Every job has its own seed, so that the order does not matter.
void run_jobs(std::vector<Job>& jobs, Calibration& calibration, Progress& progress) {
  const auto work = [&](std::size_t i) { run(jobs[i]); };
  const auto tick = [&](std::size_t done) { progress.advance(done, jobs.size()); };
  parallel_for(jobs.size(), work, tick, kWorkers);
  for (const Job& job : jobs) calibration.entries[job.entry.name] = job.entry;
  jobs.clear();
}

// Of the published law: the rate that minimises the larger of the errors of E3 and E4.
CalibrationEntry choose(const Calibration& calibration, const std::vector<double>& rates) {
  CalibrationEntry chosen;
  chosen.name = "chosen";
  chosen.objective = HUGE_VAL;
  for (double rate : rates) {
    const CalibrationEntry& e3 = calibration.e3("world-", rate);
    const CalibrationEntry& e4 = calibration.e4(rate);
    const double worst = std::max(e3.objective, e4.objective);
    if (worst >= chosen.objective) continue;
    chosen.objective = worst;
    chosen.rate = rate;
    chosen.numbers["arm2_mass_scale"] = e3.value("arm2_mass_scale");
  }
  return chosen;
}

}  // namespace

Calibration calibrate(const StudyInputs& inputs, Progress& progress) {
  const StudySettings& s = inputs.settings;
  Calibration calibration;
  calibration.optimiser = optimiser_name();
  calibration.seed = kSeed;
  std::vector<Job> jobs;

  progress.stage("calibration: published torsional law on E3", 0.45);
  for (auto rate = s.search_rates_hz.rbegin(); rate != s.search_rates_hz.rend(); ++rate)
    for (const std::string& law : kE3Laws) jobs.push_back(e3_job(inputs, law, *rate));
  run_jobs(jobs, calibration, progress);

  progress.stage("calibration: published linear law on E4", 0.25);
  for (auto rate = s.search_rates_hz.rbegin(); rate != s.search_rates_hz.rend(); ++rate)
    jobs.push_back(e4_job(inputs, *rate, calibration.e3("world-", *rate).value("arm2_mass_scale")));
  run_jobs(jobs, calibration, progress);
  calibration.entries["chosen"] = choose(calibration, s.search_rates_hz);

  progress.stage("calibration: gains by trial", 0.15);
  const StudyRobot s103 =
      StudyRobot::s103(s, inputs.s103, calibration.entry("chosen").numbers.at("arm2_mass_scale"));
  for (auto rate = s.rates_hz.rbegin(); rate != s.rates_hz.rend(); ++rate)
    for (const std::string& law : kTrialLaws)
      jobs.push_back(trial_job(fmt::format("trial/{}/{:g}", law, *rate), trial_spec(law, *rate),
                               s103, s.sweep_times));
  run_jobs(jobs, calibration, progress);

  progress.stage("calibration: two-link robots", 0.15);
  for (const char* robot : {"findings_set0", "findings_10_14"}) {
    for (auto rate = s.rates_hz.rbegin(); rate != s.rates_hz.rend(); ++rate)
      for (const char* law : {"world", "linear", "world-ratio"})
        jobs.push_back(trial_job(fmt::format("row/{}/{}/{:g}", robot, law, *rate),
                                 row_spec(law, *rate), inputs.findings.at(robot), s.sweep_times));
    for (const char* law : {"unsigned", "older", "euler"})
      jobs.push_back(trial_job(fmt::format("row/{}/{}/60", robot, law), row_spec(law, 60),
                               inputs.findings.at(robot), s.sweep_times));
  }
  run_jobs(jobs, calibration, progress);
  return calibration;
}

}  // namespace twinarm
