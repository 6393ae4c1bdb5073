#include "app/study/calibrate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <mutex>

#include "app/interrupt.h"

namespace twinarm {
namespace {

constexpr unsigned kSeed = 1;
constexpr int kFitEvaluations = 3000, kTrialEvaluations = 700;
// A fit of the folded law must hold when a gain moves by a tenth of a percent; what half a percent
// does to it is recorded.
constexpr double kShift = 1.001, kLargeShift = 1.005;

using Objective = std::function<double(const CalibrationEntry&)>;
struct Job {
  CalibrationEntry entry;
  Method method = Method::multistart;
  int evaluations = 0;
  Objective objective;
  std::function<void(CalibrationEntry&)> finish;  // writes the entry's numbers
};

// Bounds of one k and one b: four decades below what a semi-implicit step can carry at all.
std::vector<Parameter> bounds(const StudyRobot& robot, const RunSpec& spec) {
  RunSpec unit = spec;
  unit.gains = Gains::both(1, 0);
  unit.coupling.options.damper = Damper::vector_;
  RunResult predicted;
  predicted.spec = unit;
  predict(robot, predicted);
  const double h = spec.step(), per_gain = std::pow(predicted.frequency[1], 2);
  const double k = 4 / (h * h * per_gain), b = 2 / (h * per_gain);
  return {{"k", 1e-4 * k, k, 0}, {"b", 1e-4 * b, b, 0}};
}

void keep(CalibrationEntry& entry, const RunResult& result) {
  entry.numbers["max1_deg"] = result.max_deg[0];
  entry.numbers["max2_deg"] = result.max_deg[1];
  entry.numbers["mean1_deg"] = result.mean_deg[0];
  entry.numbers["mean2_deg"] = result.mean_deg[1];
}

// Worst error of the nominal gains and of each gain shifted up and down.
double robust_error(const StudyRobot& robot, RunSpec spec, const PaperRow& row, double shift,
                    double worth_it) {
  const AutomaticMotion hand{HandMapping{}};
  const Gains nominal = spec.gains;
  double worst = worst_relative_error(run(robot, hand, spec), row);
  if (worst > worth_it) return worst;  // far off: do not waste time on its neighbours
  for (double factor : {shift, 1 / shift}) {
    spec.gains = {nominal.k1 * factor, nominal.b1, nominal.k2 * factor, nominal.b2};
    worst = std::max(worst, worst_relative_error(run(robot, hand, spec), row));
    spec.gains = {nominal.k1, nominal.b1 * factor, nominal.k2, nominal.b2 * factor};
    worst = std::max(worst, worst_relative_error(run(robot, hand, spec), row));
  }
  return worst;
}

void finish_fit(CalibrationEntry& entry, const StudyRobot& robot, RunSpec spec,
                const PaperRow& row) {
  const AutomaticMotion hand{HandMapping{}};
  const RunResult result = run(robot, hand, spec);
  keep(entry, result);
  entry.numbers["worst_error"] = worst_relative_error(result, row);
  entry.numbers["worst_error_shifted"] = robust_error(robot, spec, row, kLargeShift, HUGE_VAL);
}

Job e3_job(const StudyInputs& inputs, const std::string& law, double rate) {
  Job job;
  job.entry.name = fmt::format("E3/{:g}/{}", rate, law);
  job.entry.rate = rate;
  job.entry.parameters = {{"k", 10, 3000, 0}, {"b", 0.02, 50, 0}, {"arm2_mass_scale", 0.2, 4, 0}};
  job.method = Method::rugged;
  job.evaluations = kFitEvaluations;
  const PaperRow row = paper_table().at("E3");
  const auto at = [&inputs, law, rate](const CalibrationEntry& entry) {
    RunSpec spec = e3_spec(law, rate);
    spec.gains = entry.gains();
    return std::pair{StudyRobot::s103(inputs.settings, inputs.s103, entry.value("arm2_mass_scale")),
                     spec};
  };
  job.objective = [at, row](const CalibrationEntry& entry) {
    const auto [robot, spec] = at(entry);
    return robust_error(robot, spec, row, kShift, 0.15);
  };
  job.finish = [at, row](CalibrationEntry& entry) {
    const auto [robot, spec] = at(entry);
    finish_fit(entry, robot, spec, row);
  };
  return job;
}

Job e4_job(const StudyInputs& inputs, double rate, double arm2_mass_scale) {
  Job job;
  job.entry.name = fmt::format("E4/{:g}", rate);
  job.entry.rate = rate;
  job.entry.parameters = {
      {"k1", 10, 1e6, 0}, {"b1", 0.1, 1e4, 0}, {"k2", 10, 1e6, 0}, {"b2", 0.1, 1e4, 0}};
  job.entry.numbers["arm2_mass_scale"] = arm2_mass_scale;
  job.evaluations = kFitEvaluations;
  const PaperRow row = paper_table().at("E4");
  const auto robot =
      std::make_shared<StudyRobot>(StudyRobot::s103(inputs.settings, inputs.s103, arm2_mass_scale));
  const auto at = [rate](const CalibrationEntry& entry) {
    RunSpec spec = e4_spec(rate);
    spec.gains = entry.gains();
    return spec;
  };
  job.objective = [=](const CalibrationEntry& entry) {
    const AutomaticMotion hand{HandMapping{}};
    return worst_relative_error(run(*robot, hand, at(entry)), row);
  };
  job.finish = [=](CalibrationEntry& entry) { finish_fit(entry, *robot, at(entry), row); };
  return job;
}

// The most stable movement: least objective of the protocol, one k and b.
Job trial_job(const std::string& name, const RunSpec& spec, const StudyRobot& robot,
              const std::vector<double>& sweep_times) {
  Job job;
  job.entry.name = name;
  job.entry.rate = spec.rate;
  job.entry.parameters = bounds(robot, spec);
  if (name.find("ratio") != std::string::npos) job.entry.numbers["ratio"] = 0.2;
  job.evaluations = kTrialEvaluations;
  const auto shared = std::make_shared<StudyRobot>(robot);
  const auto errors = [=](const CalibrationEntry& entry) {
    RunSpec at = spec;
    at.gains = entry.gains();
    return run_protocol(*shared, at, sweep_times);
  };
  job.objective = [=](const CalibrationEntry& entry) { return errors(entry).objective; };
  job.finish = [=](CalibrationEntry& entry) {
    const ProtocolErrors e = errors(entry);
    entry.numbers["max1_deg"] = e.max_deg[0];
    entry.numbers["max2_deg"] = e.max_deg[1];
    entry.numbers["mean1_deg"] = e.mean_deg[0];
    entry.numbers["mean2_deg"] = e.mean_deg[1];
  };
  return job;
}

// Two workers; every job seeds its own search, so the order does not matter.
void run_jobs(std::vector<Job>& jobs, Calibration& calibration, Progress& progress) {
  std::mutex mutex;
  std::size_t next = 0, done = 0;
  const auto work = [&] {
    for (;;) {
      std::size_t mine = 0;
      {
        const std::scoped_lock lock(mutex);
        if (next == jobs.size()) return;
        mine = next++;
      }
      minimise(jobs[mine].entry, jobs[mine].method, kSeed, jobs[mine].evaluations, jobs[mine].objective);
      jobs[mine].finish(jobs[mine].entry);
      const std::scoped_lock lock(mutex);
      calibration.entries[jobs[mine].entry.name] = jobs[mine].entry;
      progress.advance(static_cast<double>(++done) / static_cast<double>(jobs.size()));
    }
  };
  auto second = std::async(std::launch::async, work);
  work();
  second.get();
  jobs.clear();
}

// The law as printed and the one rate for E3 and E4 with the least of the larger of both errors.
CalibrationEntry choose(const Calibration& calibration, const std::vector<double>& rates) {
  CalibrationEntry chosen;
  chosen.name = "chosen";
  chosen.objective = HUGE_VAL;
  for (double rate : rates) {
    const CalibrationEntry& e3 = calibration.entry(fmt::format("E3/{:g}/world-", rate));
    const CalibrationEntry& e4 = calibration.entry(fmt::format("E4/{:g}", rate));
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

  progress.stage("calibration: the printed torsional law on E3", 0.45);
  for (auto rate = s.search_rates_hz.rbegin(); rate != s.search_rates_hz.rend(); ++rate)
    for (const std::string& law : e3_laws()) jobs.push_back(e3_job(inputs, law, *rate));
  run_jobs(jobs, calibration, progress);

  progress.stage("calibration: the printed linear law on E4", 0.25);
  for (auto rate = s.search_rates_hz.rbegin(); rate != s.search_rates_hz.rend(); ++rate)
    jobs.push_back(
        e4_job(inputs, *rate,
               calibration.entry(fmt::format("E3/{:g}/world-", *rate)).value("arm2_mass_scale")));
  run_jobs(jobs, calibration, progress);
  calibration.entries["chosen"] = choose(calibration, s.search_rates_hz);

  progress.stage("calibration: gains by trial", 0.15);
  const StudyRobot s103 =
      StudyRobot::s103(s, inputs.s103, calibration.entry("chosen").numbers.at("arm2_mass_scale"));
  for (auto rate = s.rates_hz.rbegin(); rate != s.rates_hz.rend(); ++rate)
    for (const std::string& law : trial_laws())
      jobs.push_back(trial_job(fmt::format("trial/{}/{:g}", law, *rate), trial_spec(law, *rate),
                               s103, s.sweep_times));
  run_jobs(jobs, calibration, progress);

  progress.stage("calibration: two-link robots of the findings", 0.15);
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
