#include "app/study/findings/findings.h"

#include <fmt/format.h>

namespace twinarm {
namespace {

// Runs a variant with the automatic motion.
using Add = std::function<void(const std::string& name, const std::string& title, RunSpec spec)>;

RunResult run_and_predict(const StudyRobot& robot, const OperatorMotion& hand,
                          const RunSpec& spec) {
  RunResult result = run(robot, hand, spec);
  predict(robot, result, robot.start_state());
  return result;
}

RunSpec consistent(CouplingSpec::Type type, SpringSpace measure, Discretization discretization,
                   double rate) {
  RunSpec spec;
  spec.coupling.type = type;
  spec.coupling.measure = measure;
  spec.coupling.discretization = discretization;
  spec.rate = rate;
  return spec;
}

void add_trials(const StudySettings& s, const Calibration& calibration, const Add& add) {
  for (const std::string& law : kTrialLaws)
    for (double rate : s.rates_hz) {
      const Gains gains = calibration.entry(fmt::format("trial/{}/{:g}", law, rate)).gains();
      add(fmt::format("trial/{}/{:g}", law, rate), law + ", optimal gains",
          trial_spec(law, rate).with_gains(gains));
    }
}

// Linear coupling with the optimal gains, consistent, and torsional coupling with its full K_q.
void add_matched(const StudySettings& s, const Calibration& calibration, const Add& add) {
  for (double rate : s.rates_hz) {
    const Gains gains = calibration.entry(fmt::format("trial/printed-linear/{:g}", rate)).gains();
    for (const auto& [name, type] : {std::pair{"linear", CouplingSpec::Type::linear},
                                     {"torsional", CouplingSpec::Type::equivalent_torsional}}) {
      RunSpec spec = consistent(type, SpringSpace::joint, Discretization::explicit_, rate);
      spec.kvr_rates = TargetRates::backward_difference;
      add(fmt::format("matched/{}/{:g}", name, rate), "the same K_q and B_q",
          spec.with_gains(gains));
    }
  }
}

void add_implicit(const StudySettings& s, const StudyRobot& robot, const Add& add) {
  struct Law {
    const char* name;
    CouplingSpec::Type type;
    SpringSpace measure;
  };
  const Law laws[] = {{"torsional-world", CouplingSpec::Type::torsional, SpringSpace::world},
                      {"torsional-joint", CouplingSpec::Type::torsional, SpringSpace::joint},
                      {"linear", CouplingSpec::Type::linear, SpringSpace::world}};
  for (const Law& law : laws)
    for (double rate : {60.0, 1000.0})
      for (Discretization discretization :
           {Discretization::explicit_, Discretization::semi_implicit, Discretization::implicit}) {
        RunSpec spec = consistent(law.type, law.measure, discretization, rate);
        spec.gains = gains_from_frequency(robot, spec.coupling, s.implicit_frequency_hz,
                                          s.implicit_damping_ratio);
        add(fmt::format("{}/{}/{:g}", discretization_name(spec.coupling), law.name, rate),
            fmt::format("{:g} Hz springs", s.implicit_frequency_hz), spec);
      }
}

// Coupling force computed at the rate and held in between, physics at about 1 kHz.
void add_held(const StudySettings& s, const Calibration& calibration, const Add& add) {
  for (const std::string& law : kTrialLaws)
    for (double rate : s.rates_hz) {
      if (rate >= s.held_physics_hz) continue;
      RunSpec spec = trial_spec(law, rate);
      spec.gains = calibration.entry(fmt::format("trial/{}/{:g}", law, rate)).gains();
      spec.held_substeps = static_cast<int>(std::lround(s.held_physics_hz / rate));
      add(fmt::format("held/{}/{:g}-held", law, rate), "force held, physics near 1 kHz", spec);
    }
}

// One change at a time to the signed coupling at 60 Hz, with its optimal gains.
void add_ablations(const Calibration& calibration, const Add& add) {
  constexpr double rate = 60;
  const Gains gains = calibration.entry("trial/signed-torsional/60").gains();
  const RunSpec base = trial_spec("signed-torsional", rate).with_gains(gains);
  add("ablation/signed", "signed damper, backward differences", base);
  RunSpec spec = base;
  spec.coupling.options.damper = Damper::folded;
  add("ablation/folded", "unsigned angle, folded, as published", spec);
  spec.coupling.options.damping_sign = 1;
  add("ablation/folded-along", "the same, damping torque along the KVR's motion", spec);
  spec = base;
  spec.coupling.options.damper = Damper::unsigned_;
  add("ablation/unsigned", "unsigned speed, not folded", spec);
  spec = base;
  spec.coupling.options.difference = Difference::per_frame;
  add("ablation/per-frame", "angle per frame, not divided by h", spec);
  spec = base;
  spec.coupling.options.difference = Difference::older;
  add("ablation/older", "difference one frame older", spec);
  spec = consistent(CouplingSpec::Type::torsional, SpringSpace::world, Discretization::explicit_,
                    rate);
  add("ablation/true-velocities", "current velocities of both robots", spec.with_gains(gains));
  add("ablation/ratio-0.2", "k2 = 0.2 k1, with its own optimal gains",
      trial_spec("signed-torsional-ratio", rate)
          .with_gains(calibration.entry("trial/signed-torsional-ratio/60").gains()));
}

}  // namespace

std::vector<RunSpec> reproduction_specs(const Calibration& calibration) {
  const double rate = calibration.entry("chosen").rate;
  const Gains e3 = calibration.e3("world-", rate).gains();
  const Gains e4 = calibration.e4(rate).gains();
  std::vector<RunSpec> specs;
  for (const char* name : {"E1", "E2", "E3", "E4"}) {
    const bool torsional = name[1] == '1' || name[1] == '3', by_user = name[1] < '3';
    RunSpec spec =
        torsional ? e3_spec("world-", rate).with_gains(e3) : e4_spec(rate).with_gains(e4);
    spec.name = name;
    spec.title = fmt::format("{}, {}", torsional ? "torsional" : "linear",
                             by_user ? "by user" : "automatic");
    specs.push_back(spec);
  }
  return specs;
}

std::vector<RunResult> run_reproduction(const StudyRobot& robot, const Calibration& calibration,
                                        const OperatorMotion& hand) {
  const AutomaticMotion automatic{OperatorMapping{}};
  std::vector<RunResult> results;
  for (RunSpec& spec : reproduction_specs(calibration)) {
    const bool by_user = spec.name < "E3";
    if (by_user && dynamic_cast<const SyntheticOperator*>(&hand))
      spec.title += " (synthetic operator)";
    results.push_back(run_and_predict(robot, by_user ? hand : automatic, spec));
  }
  return results;
}

std::vector<RunResult> run_variants(const StudyInputs& inputs, const StudyRobot& robot,
                                    const Calibration& calibration, Progress& progress) {
  const std::size_t rates = inputs.settings.rates_hz.size();
  const std::size_t expected = kTrialLaws.size() * (2 * rates - 1) + 2 * rates + 18 + 8;
  const AutomaticMotion hand{OperatorMapping{}};
  std::vector<RunResult> results;
  const Add add = [&](const std::string& name, const std::string& title, RunSpec spec) {
    spec.name = name;
    spec.title = title;
    results.push_back(run_and_predict(robot, hand, spec));
    progress.advance(results.size(), expected);
  };
  add_trials(inputs.settings, calibration, add);
  add_matched(inputs.settings, calibration, add);
  add_implicit(inputs.settings, robot, add);
  add_held(inputs.settings, calibration, add);
  add_ablations(calibration, add);
  return results;
}

Gains gains_from_frequency(const StudyRobot& robot, const CouplingSpec& coupling,
                           double frequency_hz, double damping_ratio) {
  const Eigen::Matrix2d M = robot.start_inertia(coupling.type);
  const double w = 2 * std::numbers::pi * frequency_hz;
  double I1 = M(0, 0), I2 = M(1, 1);
  if (coupling.type != CouplingSpec::Type::torsional) {
    const std::vector<Spring> springs = robot.springs(Gains::both(1, 1));
    I1 /= springs[0].p_L.head<2>().squaredNorm();
    I2 /= springs[1].p_L.head<2>().squaredNorm();
  }
  const double b = 2 * damping_ratio * w;
  return {w * w * I1, b * I1, w * w * I2, b * I2};
}

const RunResult* find_run(const std::vector<RunResult>& runs, const std::string& name) {
  for (const RunResult& result : runs)
    if (result.spec.name == name) return &result;
  return nullptr;
}

}  // namespace twinarm
