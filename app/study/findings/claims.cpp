// Claims on modes of equal gains and their prediction, gains of one coupling used in the other,
// gains that make torsional and linear equivalent; the damping term as published, folded, signed
// and per frame, and stability limits.
#include <fmt/format.h>

#include "app/study/findings/findings.h"

namespace twinarm {
namespace {

// Ratio of the squared natural frequencies of equal gains at q2 = 0.
double mode_ratio(const StudyRobot& robot, const std::string& law) {
  RunResult equal;
  equal.spec = row_spec(law, 1000);
  if (law == "joint") equal.spec.coupling.measure = SpringSpace::joint;
  equal.spec.gains = Gains::both(1, 1);
  predict(robot, equal, State<double>(robot.kvr_model()));
  return std::pow(equal.frequency[1] / equal.frequency[0], 2);
}

void add_modes(const StudyInputs& inputs, const Value& predictions,
               std::vector<Finding>& findings) {
  for (const Value& modes : entry_of(predictions, "modes").items)
    for (const char* law : {"joint", "linear", "world"}) {
      const Value* ratio = modes.find(law);
      if (!ratio) continue;
      const std::string& robot = entry_of(modes, "robot").text;
      const double measured = mode_ratio(inputs.findings.at(robot), law);
      findings.push_back({"equal gains",
                          fmt::format("{}, {}: with equal gains on both links the ratio of the "
                                      "squared natural frequencies is {:g} (predicted)",
                                      run_words(robot), run_words(law), ratio->number),
                          fmt::format("{:.2f}", measured), is_near(measured, ratio->number, 0.02)});
    }
}

// Springs at point masses with stiffness proportional to mass: K = (k/m) M, one frequency for all
// modes.
void add_proportional_springs(std::vector<Finding>& findings) {
  const double l1 = 0.25, l2 = 0.35, m1 = 5, m2 = 3;
  ModelBuilder builder;
  const auto point = [](double m, double l) { return BodyInertia{m, {l, 0, 0}, Matrix3::Zero()}; };
  builder.add_body("arm1", 0, "joint1", JointType::revolute, {}, Vector3::UnitZ(), point(m1, l1));
  builder.add_body("arm2", 1, "joint2", JointType::revolute, {Matrix3::Identity(), {l1, 0, 0}},
                   Vector3::UnitZ(), point(m2, l2));
  const Model<double> model = builder.build();
  double worst = 0;
  for (double q2 : {-2.0, -0.7, 0.0, 0.4, 1.9}) {
    State<double> x(model);
    x.q[1] = q2;
    const Kinematics k = kinematics_at(model, x);
    Eigen::Matrix2d K = Eigen::Matrix2d::Zero();
    for (const auto& [body, l, m] : {std::tuple{1, l1, m1}, {2, l2, m2}}) {
      const auto J = point_jacobian(model, k, body, k.position(body, {l, 0, 0}));
      K += m * J.transpose() * J;
    }
    const Eigen::MatrixXd M = mass_matrix(model, x);
    worst = std::max(worst, (K - M).norm() / M.norm());
  }
  findings.push_back({"equal gains",
                      "linear springs at point masses, with stiffness proportional to mass, give K "
                      "= (k/m) M in every pose: one frequency for all modes",
                      fmt::format("largest deviation {:.1e}", worst), worst < 1e-12});
}

void add_exchanged_gains(const StudyInputs& inputs, std::vector<Finding>& findings) {
  for (const char* name : kTwoLinkRobots) {
    const StudyRobot& robot = inputs.findings.at(name);
    const RunResult torsional = run_automatic(robot, row_spec("world", 1000), 22000, 400, 1000);
    const RunResult linear = run_automatic(robot, row_spec("linear", 1000), 1200, 40, 1000);
    findings.push_back(
        {"equal gains",
         fmt::format("{}: the gains of a good linear coupling (22 kN/m, 400 N s/m), used as "
                     "torsional gains, diverge at 1 kHz; those of a good torsional coupling (1.2 "
                     "kN m/rad, 40 N m s/rad), used as linear gains, are far too soft",
                     run_words(name)),
         fmt::format("torsional {}; linear {} deg", torsional.stable ? "stable" : "diverges",
                     words(linear.max_deg)),
         !torsional.stable && linear.max_deg[1] > 10});
  }
}

}  // namespace

void add_equal_gains(const StudyInputs& inputs, const Value& predictions,
                     std::vector<Finding>& findings) {
  add_modes(inputs, predictions, findings);
  add_proportional_springs(findings);
  add_exchanged_gains(inputs, findings);
}

bool have_equal_errors(const RunResult& linear, const RunResult& torsional) {
  const auto agree = [&](std::size_t j) {
    return std::abs(linear.max_deg[j] - torsional.max_deg[j]) <
           std::max(0.1, 0.1 * linear.max_deg[j]);
  };
  return agree(0) && agree(1);
}

void add_matched_gains(const StudyResults& results, std::vector<Finding>& findings) {
  const auto get = [&](const std::string& name) { return find_run(results.variants, name); };
  for (double rate : {60.0, 1000.0}) {
    const RunResult* linear = get(fmt::format("matched/linear/{:g}", rate));
    const RunResult* full = get(fmt::format("matched/torsional/{:g}", rate));
    if (!linear || !full) continue;
    findings.push_back(
        {"matched gains",
         fmt::format("S-103, {:g} Hz: a torsional coupling with the full K_q, B_q of the linear "
                     "one has the same largest errors (within 0.1 degree or 10 %)",
                     rate),
         fmt::format("linear {} deg, torsional {} deg", words(linear->max_deg),
                     words(full->max_deg)),
         have_equal_errors(*linear, *full)});
  }
  const RunResult& equal = *get("trial/signed-torsional/60");
  const RunResult& ratio = *get("trial/signed-torsional-ratio/60");
  findings.push_back(
      {"matched gains",
       "S-103, 60 Hz: k2 = 0.2 k1 instead of equal gains reduces the torsional coupling's largest "
       "error",
       fmt::format("equal {} deg, ratio {} deg", words(equal.max_deg), words(ratio.max_deg)),
       ratio.largest_deg() < equal.largest_deg()});
  for (const char* law : {"torsional-world", "linear"}) {
    const RunResult* implicit = get(fmt::format("implicit/{}/1000", law));
    const RunResult* slow = get(fmt::format("implicit/{}/60", law));
    const RunResult* explicit_60 = get(fmt::format("explicit/{}/60", law));
    findings.push_back(
        {"implicit",
         fmt::format("S-103, {}, implicit at 1 kHz: errors of both joints below 1.5 deg; at 60 Hz "
                     "the same gains are stable implicitly and diverge explicitly",
                     run_words(law)),
         fmt::format("1 kHz {} deg; 60 Hz implicit {} deg, explicit {}", words(implicit->max_deg),
                     words(slow->max_deg), explicit_60->stable ? "stable" : "diverges"),
         implicit->largest_deg() < 1.5 && slow->stable && !explicit_60->stable});
  }
}

void add_damping(const StudyInputs& inputs, std::vector<Finding>& findings) {
  for (const char* name : kTwoLinkRobots) {
    const StudyRobot& robot = inputs.findings.at(name);
    RunSpec spec = trial_spec("signed-torsional", 1000);
    const RunResult signed_run = run_automatic(robot, spec, 1200, 40, 1000);
    spec.coupling.options.difference = Difference::per_frame;
    const RunResult per_frame = run_automatic(robot, spec, 1200, 40, 1000);
    spec = trial_spec("printed-torsional", 1000);
    spec.coupling.options.damping_sign = 1;
    const RunResult folded = run_automatic(robot, spec, 1200, 40, 1000);
    spec.coupling.options.damper = Damper::unsigned_;
    const RunResult along = run_automatic(robot, spec, 1200, 40, 1000);
    spec.coupling.options.damping_sign = -1;
    const RunResult against = run_automatic(robot, spec, 1200, 40, 1000);
    findings.push_back(
        {"damping term",
         fmt::format("{}, k = 1200 N m/rad, b = 40 N m s/rad, 1 kHz: an unsigned damper adds "
                     "energy at the reversals and diverges with either sign; folded it is bounded, "
                     "with errors several times those of the signed damper",
                     run_words(name)),
         fmt::format("signed {}, folded {}, unfolded {} and {}", words(signed_run.max_deg),
                     words(folded.max_deg), along.stable ? "stable" : "diverges",
                     against.stable ? "stable" : "diverges"),
         !along.stable && !against.stable && folded.stable &&
             folded.max_deg[0] > 2 * signed_run.max_deg[0]});
    findings.push_back(
        {"damping term",
         fmt::format("{}: an angle per frame, not divided by h, reduces the damping to b h; the "
                     "mean error approaches half the maximum, which indicates undamped oscillation",
                     run_words(name)),
         fmt::format("{} deg, mean {}; mean/max {:.2f} instead of {:.2f}", words(per_frame.max_deg),
                     words(per_frame.mean_deg), per_frame.mean_deg[0] / per_frame.max_deg[0],
                     signed_run.mean_deg[0] / signed_run.max_deg[0]),
         per_frame.mean_deg[0] / per_frame.max_deg[0] > 0.4});
  }
}

void add_differences(const StudyInputs& inputs, const StudyResults& results,
                     std::vector<Finding>& findings) {
  for (const char* name : kTwoLinkRobots) {
    const StudyRobot& robot = inputs.findings.at(name);
    RunSpec spec = row_spec("world", 60);
    spec.gains = results.calibration.entry(fmt::format("row/{}/world/60", name)).gains();
    const ProtocolErrors difference = run_protocol(robot, spec, inputs.settings.sweep_times);
    spec.kvr_rates = TargetRates::from_operator;
    const ProtocolErrors current = run_protocol(robot, spec, inputs.settings.sweep_times);
    findings.push_back(
        {"differences",
         fmt::format("{}: with semi-implicit steps backward differences change the largest error "
                     "of joint 1 by at most 10 %, because the DVR's difference is its velocity",
                     run_words(name)),
         fmt::format("60 Hz: {} with differences, {} with current velocities",
                     words(difference.max_deg), words(current.max_deg)),
         is_near(difference.max_deg[0], current.max_deg[0], 0.1)});
  }
}

// Runs below the minimum and above the maximum of the stability limits of the poses of the motion.
// In between the arm passes through unstable poses without diverging.
void add_stability(const StudyInputs& inputs, std::vector<Finding>& findings) {
  for (const char* name : kTwoLinkRobots) {
    const StudyRobot& robot = inputs.findings.at(name);
    RunResult predicted;
    predicted.spec = row_spec("world", 1000);
    predicted.spec.gains = Gains::both(1200, 40);
    double min_limit = HUGE_VAL, max_limit = 0;
    for (double q2 = -45; q2 <= 45; q2 += 5) {
      State<double> pose = robot.start_state();
      pose.q[1] = q2 * std::numbers::pi / 180;
      predict(robot, predicted, pose);
      min_limit = std::min(min_limit, predicted.step_limit);
      max_limit = std::max(max_limit, predicted.step_limit);
    }
    const auto run_at = [&](double step) {
      return run_automatic(robot, row_spec("world", 1000), 1200, 40, 1 / step);
    };
    const RunResult below = run_at(0.97 * min_limit), above = run_at(1.03 * max_limit);
    findings.push_back(
        {"stability",
         fmt::format(
             "{}, world orientation, k = 1200 N m/rad, b = 40 N m s/rad: by theory steps up to "
             "{:.2f} ms are stable in every pose of the motion, and above {:.2f} ms in none",
             run_words(name), 1e3 * min_limit, 1e3 * max_limit),
         fmt::format("3 % below the first: {} deg; 3 % above the second: {}", words(below.max_deg),
                     above.stable ? words(above.max_deg) + " deg" : "diverges"),
         below.stable && (!above.stable || above.max_deg[0] > 5 * below.max_deg[0])});
  }
}

}  // namespace twinarm
