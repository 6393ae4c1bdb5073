#include "app/study/study_run.h"

namespace twinarm {
namespace {

const Eigen::Vector2d kSweep(-std::numbers::pi, std::numbers::pi / 2);  // of T = 1 s [rad/s]

// With joint stops.
TrackingSeries track(const StudyRobot& robot, const OperatorMotion& hand, const RunSpec& spec) {
  TrackingSystem system(tracking_setup(robot, hand, spec));
  JointStops stops("stops", robot.dvr_model(spec.coupling.type), robot.stops());
  if (!robot.stops().empty()) system.simulation().add(stops);
  return system.run();
}

SteppingScheme scheme_of(const RunSpec& run) {
  const CouplingSpec& spec = run.coupling;
  const bool older = spec.printed && spec.options.difference == Difference::older;
  if (run.held_substeps > 1)
    return spec.printed ? SteppingScheme::hold_difference : SteppingScheme::hold;
  if (run.integrator == Integrator::euler)
    return spec.printed ? SteppingScheme::euler_difference : SteppingScheme::euler;
  if (older) return SteppingScheme::semi_implicit_older;
  if (spec.printed) return SteppingScheme::semi_implicit_difference;
  switch (spec.discretization) {
    case Discretization::explicit_:
      return SteppingScheme::semi_implicit;
    case Discretization::semi_implicit:
      return SteppingScheme::implicit_damper;
    case Discretization::implicit:
      break;
  }
  return SteppingScheme::implicit;
}

void measure(const TrackingSeries& series, RunResult& result) {
  const TrackingError error = tracking_error(series);
  for (std::size_t j = 0; j < 2; ++j) {
    result.max_deg[j] = error.max[j] / kDegree;
    result.mean_deg[j] = error.mean[j] / kDegree;
  }
  result.stable = series.finite && result.largest_deg() < 180;
}

// Child link of a joint and its descendants.
std::vector<std::string> links_outward(const RobotDescription& robot, const std::string& joint) {
  std::vector<std::string> links;
  for (const JointDescription& j : robot.joints)
    if (j.name == joint) links.push_back(j.child);
  for (std::size_t n = 0; n < links.size(); ++n)
    for (const JointDescription& j : robot.joints)
      if (j.parent == links[n]) links.push_back(j.child);
  return links;
}

// Implicit spring-damper of a joint coordinate, from frequency and damping ratio with the inertia
// of that joint, all others locked.
CouplingSpec joint_hold(const Model<double>& model, const std::string& joint, double frequency_hz,
                        double damping_ratio) {
  const int body = model.find_joint(joint);
  const auto dof = static_cast<Eigen::Index>(model.iv[static_cast<std::size_t>(body)]);
  const double I = mass_matrix(model, State<double>(model))(dof, dof);
  const double w = 2 * std::numbers::pi * frequency_hz;
  CouplingSpec spec;
  spec.name = joint;
  spec.measure = SpringSpace::joint;
  spec.discretization = Discretization::implicit;
  spec.springs = {{joint, body, Vector3::Zero(), I * w * w, 2 * damping_ratio * I * w}};
  return spec;
}

// The coupling with the gains, linear about a pose of the DVR; joints 1 and 2.
class Linearisation {
 public:
  struct Matrices {
    Eigen::Matrix2d M, K, B;
  };
  Linearisation(const StudyRobot& robot, const RunSpec& spec)
      : model_(robot.dvr_model(spec.coupling.type)),
        hand_(OperatorMapping{}),
        kvr_(robot.kvr_model(), hand_, OperatorMapping{}, robot.joints()),
        k_(model_) {
    CouplingSpec main = spec.coupling;
    main.springs = robot.springs(spec.gains);
    coupling_ = make_coupling(main, model_, kvr_);
  }
  Matrices operator()(const State<double>& pose) {
    forward_kinematics(model_, pose, k_);
    const Coupling::JointSpace full = coupling_->joint_space(k_);
    return {mass_matrix(model_, pose).topLeftCorner<2, 2>(), full.K.topLeftCorner<2, 2>(),
            full.B.topLeftCorner<2, 2>()};
  }

 private:
  const Model<double>& model_;
  AutomaticMotion hand_;
  TargetRobot kvr_;
  std::unique_ptr<Coupling> coupling_;
  Kinematics k_;
};

// visit(M, K, B) at equidistant poses of the first sweep, both ends included.
template <class Visit>
void for_poses_of_motion(const StudyRobot& robot, const RunSpec& spec, Visit&& visit) {
  constexpr int kIntervals = 20;
  Linearisation linearise(robot, spec);
  for (int n = 0; n <= kIntervals; ++n) {
    const auto [M, K, B] = linearise(robot.pose_of_motion(static_cast<double>(n) / kIntervals));
    visit(M, K, B);
  }
}

}  // namespace

TrackingSetup tracking_setup(const StudyRobot& robot, const OperatorMotion& hand,
                             const RunSpec& spec) {
  TrackingSetup setup;
  setup.kvr_model = &robot.kvr_model();
  setup.dvr_model = &robot.dvr_model(spec.coupling.type);
  setup.motion = &hand;
  setup.joints = robot.joints();
  setup.kvr_rates = spec.kvr_rates;
  setup.integrator = spec.integrator;
  setup.h = spec.step();
  CouplingSpec main = spec.coupling;
  main.springs = robot.springs(spec.gains);
  main.options.hold_steps = spec.held_substeps;
  if (spec.held_substeps > 1) main.hold_steps = spec.held_substeps;
  setup.couplings = {main};
  for (const CouplingSpec& held : robot.auxiliary()) setup.couplings.push_back(held);
  return setup;
}

RunResult run(const StudyRobot& robot, const OperatorMotion& hand, const RunSpec& spec) {
  RunResult result;
  result.spec = spec;
  result.series = track(robot, hand, spec);
  measure(result.series, result);
  return result;
}

void predict(const StudyRobot& robot, RunResult& result, const State<double>& pose) {
  const RunSpec& spec = result.spec;
  const auto [M, K, B] = Linearisation(robot, spec)(pose);
  const Eigen::VectorXd squares = squared_frequencies(M, K);
  result.frequency = {std::sqrt(std::max(0.0, squares(0))), std::sqrt(std::max(0.0, squares(1)))};
  const SpringModes modes = spring_modes(M, K, B);
  for (Eigen::Index i = 0; i < std::min<Eigen::Index>(2, modes.size()); ++i)
    result.damping_ratio[static_cast<std::size_t>(i)] = modes.zeta(i);
  result.step_limit = max_stable_step(M, K, B, scheme_of(spec));
  const Eigen::VectorXd peak = response_to_velocity_steps(M, K, B, {{0, 2 * kSweep}}, 1).peak;
  const JumpErrors motion =
      response_to_velocity_steps(M, K, B, {{0, kSweep}, {1, -2 * kSweep}, {2, 2 * kSweep}}, 3);
  for (Eigen::Index j = 0; j < 2; ++j) {
    const auto joint = static_cast<std::size_t>(j);
    result.peak_deg[joint] = peak(j) / kDegree;
    result.motion_max_deg[joint] = motion.peak(j) / kDegree;
    result.motion_mean_deg[joint] = motion.mean(j) / kDegree;
  }
}

double step_limit_of_motion(const StudyRobot& robot, const RunSpec& spec) {
  double limit = HUGE_VAL;
  for_poses_of_motion(robot, spec, [&](const auto& M, const auto& K, const auto& B) {
    limit = std::min(limit, max_stable_step(M, K, B, scheme_of(spec)));
  });
  return limit;
}

double reversal_peak_of_motion(const StudyRobot& robot, const RunSpec& spec) {
  double sum = 0;
  for_poses_of_motion(robot, spec, [&](const auto& M, const auto& K, const auto& B) {
    const JumpErrors errors = response_to_velocity_steps(M, K, B, {{0, 2 * kSweep}}, 1);
    sum = std::max(sum, errors.peak.sum());
  });
  return sum / kDegree;
}

ProtocolErrors run_protocol(const StudyRobot& robot, const RunSpec& spec,
                            const std::vector<double>& sweep_times) {
  ProtocolErrors errors;
  for (double T : sweep_times) {
    RunResult result;
    measure(track(robot, AutomaticMotion(OperatorMapping{}, T), spec), result);
    if (!result.stable) return {{180, 180}, {180, 180}, kUnstable};
    for (std::size_t j = 0; j < 2; ++j) {
      errors.max_deg[j] = std::max(errors.max_deg[j], T * result.max_deg[j]);
      errors.mean_deg[j] += T * result.mean_deg[j] / static_cast<double>(sweep_times.size());
    }
    errors.objective = std::max(errors.objective, T * (result.max_deg[0] + result.max_deg[1]));
  }
  return errors;
}

std::vector<double> in_degrees(std::vector<double> radians) {
  for (double& x : radians) x /= kDegree;
  return radians;
}

std::vector<double> error_deg(const TrackingSeries& series, std::size_t joint) {
  std::vector<double> error(series.t.size());
  for (std::size_t n = 0; n < error.size(); ++n)
    error[n] = std::abs(series.q_K[joint][n] - series.q_D[joint][n]) / kDegree;
  return error;
}

const char* discretization_name(const CouplingSpec& spec) {
  return spec.printed ? "as printed" : name_of(spec.discretization);
}

std::string coupling_words(const CouplingSpec& spec) {
  if (spec.type == CouplingSpec::Type::linear) return "linear";
  if (spec.type == CouplingSpec::Type::equivalent_torsional)
    return "torsional, full K_q of the linear coupling";
  const SpringSpace measure = spec.printed ? spec.options.measure : spec.measure;
  return measure == SpringSpace::world ? "torsional, world orientation" : "torsional, joint angle";
}

StudyRobot StudyRobot::s103(const StudySettings& settings, const RobotDescription& description,
                            double arm2_mass_scale) {
  StudyRobot robot;
  robot.name_ = description.name;
  robot.joints_ = settings.joints;
  robot.mounts_ = settings.mounts;
  ModelOptions options;
  for (const std::string& link : links_outward(description, settings.joints.turned.at(1)))
    options.mass_scale[link] = arm2_mass_scale;
  robot.plain_ = options;
  robot.kvr_model_ = robot.dvr_plain_ = build_model(description, options);
  for (const Mount& mount : settings.mounts)
    options.added_masses.push_back({mount.link, mount.p_L, settings.added_mass});
  robot.weighted_ = options;
  robot.dvr_weighted_ = build_model(description, options);

  for (const std::string& joint : {settings.joints.turned.at(2), settings.joints.gripper})
    robot.auxiliary_.push_back(joint_hold(robot.dvr_plain_, joint, settings.auxiliary_frequency_hz,
                                          settings.auxiliary_damping_ratio));
  robot.stops_ = {{robot.kvr_model_.find_joint(settings.joints.gripper),
                   settings.joints.gripper_open, settings.joints.gripper_closed,
                   settings.stop_stiffness, settings.stop_damping}};
  return robot;
}

StudyRobot StudyRobot::findings(const RobotDescription& description) {
  StudyRobot robot;
  robot.name_ = description.name;
  robot.joints_.turned = {"joint1", "joint2"};
  robot.kvr_model_ = robot.dvr_plain_ = robot.dvr_weighted_ = build_model(description);
  for (const std::string& joint : robot.joints_.turned)
    for (const LinkDescription& link : description.links)
      if (link.name == links_outward(description, joint)[0])
        robot.mounts_.push_back({link.name, link.com});
  return robot;
}

std::vector<Spring> StudyRobot::springs(const Gains& g) const {
  const auto body = [&](std::size_t m) { return kvr_model_.find_body(mounts_.at(m).link); };
  return {{"joint1", body(0), mounts_[0].p_L, g.k1, g.b1},
          {"joint2", body(1), mounts_[1].p_L, g.k2, g.b2}};
}

State<double> StudyRobot::pose_of_motion(double share) const {
  State<double> x(kvr_model_);
  const auto set = [&](std::size_t j, double q) {
    x.q[kvr_model_.iq[static_cast<std::size_t>(kvr_model_.find_joint(joints_.turned[j]))]] = q;
  };
  set(0, std::numbers::pi / 2 - std::numbers::pi * share);
  set(1, -std::numbers::pi / 4 + std::numbers::pi / 2 * share);
  return x;
}

Eigen::Matrix2d StudyRobot::start_inertia(CouplingSpec::Type type) const {
  return mass_matrix(dvr_model(type), start_state()).topLeftCorner<2, 2>();
}

}  // namespace twinarm
