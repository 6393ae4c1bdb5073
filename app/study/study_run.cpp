#include "app/study/study_run.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/laws/discretization.h"

namespace twinarm {
namespace {

// A system of KVR, DVR, studied coupling, auxiliary couplings and joint stops.
TrackingSeries track(const StudyRobot& robot, const HandSource& hand, const RunSpec& spec) {
  TrackingSetup setup;
  setup.kvr_model = &robot.kvr_model();
  setup.dvr_model = &robot.dvr_model(spec.coupling.type);
  setup.hand = &hand;
  setup.joints = robot.joints();
  setup.kvr_rates = spec.kvr_rates;
  setup.integrator = spec.integrator;
  setup.h = spec.step();
  CouplingSpec main = spec.coupling;
  main.springs = robot.springs(spec.gains.k1, spec.gains.b1, spec.gains.k2, spec.gains.b2);
  main.options.hold_steps = spec.held_substeps;
  if (spec.held_substeps > 1) main.hold_steps = spec.held_substeps;
  setup.couplings = {main};
  for (const CouplingSpec& held : robot.auxiliary()) setup.couplings.push_back(held);
  TrackingSystem system(setup);
  JointStops stops("stops", *setup.dvr_model, robot.stops());
  if (!robot.stops().empty()) system.simulation().add(stops);
  return system.run();
}

Scheme scheme_of(const RunSpec& run) {
  const CouplingSpec& spec = run.coupling;
  const bool older = spec.printed && spec.options.difference == Difference::older;
  if (run.held_substeps > 1) return spec.printed ? Scheme::hold_difference : Scheme::hold;
  if (run.integrator == Integrator::euler)
    return spec.printed ? Scheme::euler_difference : Scheme::euler;
  if (older) return Scheme::semi_implicit_older;
  if (spec.printed) return Scheme::semi_implicit_difference;
  switch (spec.treatment) {
    case Treatment::explicit_:
      return Scheme::semi_implicit;
    case Treatment::semi_implicit:
      return Scheme::implicit_damper;
    case Treatment::implicit:
      break;
  }
  return Scheme::implicit;
}

void measure(const TrackingSeries& series, RunResult& result) {
  const TrackingError error = tracking_error(series);
  for (std::size_t j = 0; j < 2; ++j) {
    result.max_deg[j] = error.max[j] / kDegree;
    result.mean_deg[j] = error.mean[j] / kDegree;
  }
  result.stable = series.finite && std::max(result.max_deg[0], result.max_deg[1]) < 180;
}

}  // namespace

RunResult run(const StudyRobot& robot, const HandSource& hand, const RunSpec& spec) {
  RunResult result;
  result.spec = spec;
  result.series = track(robot, hand, spec);
  measure(result.series, result);
  return result;
}

void predict(const StudyRobot& robot, RunResult& result) {
  predict(robot, result, robot.start_state());
}

void predict(const StudyRobot& robot, RunResult& result, const State<double>& pose) {
  const RunSpec& spec = result.spec;
  const Model<double>& model = robot.dvr_model(spec.coupling.type);
  const AutomaticMotion hand{HandMapping{}};
  KinematicRobot kvr(robot.kvr_model(), hand, HandMapping{}, robot.joints());
  CouplingSpec main = spec.coupling;
  main.springs = robot.springs(spec.gains.k1, spec.gains.b1, spec.gains.k2, spec.gains.b2);
  const auto coupling = make_coupling(main, model, kvr);
  Kinematics k(model);
  forward_kinematics(model, pose, k);
  const Coupling::JointSpace full = coupling->joint_space(k);
  const Eigen::Matrix2d M = mass_matrix(model, pose).topLeftCorner<2, 2>();
  const Eigen::Matrix2d K = full.K.topLeftCorner<2, 2>(), B = full.B.topLeftCorner<2, 2>();

  const Eigen::VectorXd squares = squared_frequencies(M, K);
  result.frequency = {std::sqrt(std::max(0.0, squares(0))), std::sqrt(std::max(0.0, squares(1)))};
  result.step_limit = largest_stable_step(M, K, B, scheme_of(spec));
  const Eigen::Vector2d sweep(-std::numbers::pi, std::numbers::pi / 2);  // [rad/s]
  const Eigen::VectorXd peak = peak_after_jump(M, K, B, 2 * sweep, 1.0);
  const JumpErrors motion =
      errors_of_jumps(M, K, B, {{0, sweep}, {1, -2 * sweep}, {2, 2 * sweep}}, 3);
  for (Eigen::Index j = 0; j < 2; ++j) {
    const auto joint = static_cast<std::size_t>(j);
    result.peak_deg[joint] = peak(j) / kDegree;
    result.motion_max_deg[joint] = motion.peak(j) / kDegree;
    result.motion_mean_deg[joint] = motion.mean(j) / kDegree;
  }
}

ProtocolErrors run_protocol(const StudyRobot& robot, const RunSpec& spec,
                            const std::vector<double>& sweep_times) {
  ProtocolErrors errors;
  for (double T : sweep_times) {
    RunResult result;
    measure(track(robot, AutomaticMotion(HandMapping{}, T), spec), result);
    if (!result.stable) return {{180, 180}, {180, 180}, 1e6};
    for (std::size_t j = 0; j < 2; ++j) {
      errors.max_deg[j] = std::max(errors.max_deg[j], T * result.max_deg[j]);
      errors.mean_deg[j] += T * result.mean_deg[j] / static_cast<double>(sweep_times.size());
    }
    errors.objective = std::max(errors.objective, T * (result.max_deg[0] + result.max_deg[1]));
  }
  return errors;
}

const char* treatment_name(const CouplingSpec& spec) {
  if (spec.printed) return "as printed";
  return name_of(spec.treatment);
}

std::string coupling_words(const CouplingSpec& spec) {
  if (spec.type == CouplingSpec::Type::linear) return "linear";
  if (spec.type == CouplingSpec::Type::matched) return "torsional, full K_q of the linear one";
  const Measure measure = spec.printed ? spec.options.measure : spec.measure;
  return measure == Measure::world ? "torsional, world orientation" : "torsional, joint angle";
}

}  // namespace twinarm
