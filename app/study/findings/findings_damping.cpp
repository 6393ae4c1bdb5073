// The damping term as printed, folded, signed and per frame, and the steps at which it is stable.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "app/study/findings/findings.h"
#include "app/study/findings/findings_detail.h"

namespace twinarm {

void add_damping(const StudyInputs& inputs, std::vector<Finding>& findings) {
  for (const char* name : {"findings_set0", "findings_10_14"}) {
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
         fmt::format(
             "{}, k = 1200, b = 40, 1 kHz: an unsigned damper pumps energy at the reversals "
             "and diverges, whatever its sign; the fold keeps it bounded, several times "
             "worse than the signed damper",
             robot_words(name)),
         fmt::format("signed {}, folded {}, unfolded {} and {}", words(signed_run.max_deg),
                     words(folded.max_deg), along.stable ? "stable" : "diverges",
                     against.stable ? "stable" : "diverges"),
         !along.stable && !against.stable && folded.stable &&
             folded.max_deg[0] > 2 * signed_run.max_deg[0]});
    findings.push_back(
        {"damping term",
         fmt::format(
             "{}: an angle per frame that is not divided by h leaves b h of the damping; the "
             "mean error grows towards half the maximum, the mark of ringing",
             robot_words(name)),
         fmt::format("{} deg, mean {}; mean/max {:.2f} instead of {:.2f}", words(per_frame.max_deg),
                     words(per_frame.mean_deg), per_frame.mean_deg[0] / per_frame.max_deg[0],
                     signed_run.mean_deg[0] / signed_run.max_deg[0]),
         per_frame.mean_deg[0] / per_frame.max_deg[0] > 0.4});
  }
}

void add_differences(const StudyInputs& inputs, const StudyResults& results,
                     std::vector<Finding>& findings) {
  for (const char* name : {"findings_set0", "findings_10_14"}) {
    const StudyRobot& robot = inputs.findings.at(name);
    RunSpec spec = row_spec("world", 60);
    spec.gains = results.calibration.entry(fmt::format("row/{}/world/60", name)).gains();
    const ProtocolErrors difference = run_protocol(robot, spec, inputs.settings.sweep_times);
    spec.kvr_rates = KvrRates::from_hand;
    const ProtocolErrors current = run_protocol(robot, spec, inputs.settings.sweep_times);
    findings.push_back(
        {"differences",
         fmt::format("{}: with semi-implicit steps backward differences cost little, for the DVR's "
                     "difference is its velocity",
                     robot_words(name)),
         fmt::format("60 Hz: {} with differences, {} with current velocities",
                     words(difference.max_deg), words(current.max_deg)),
         is_near(difference.max_deg[0], current.max_deg[0], 0.1)});
  }
}

// The largest stable steps that theory gives for the poses of the motion, against runs below all of
// them and above all of them. Between the two the arm passes through unstable poses unharmed.
void add_stability(const StudyInputs& inputs, std::vector<Finding>& findings) {
  for (const char* name : {"findings_set0", "findings_10_14"}) {
    const StudyRobot& robot = inputs.findings.at(name);
    RunResult predicted;
    predicted.spec = row_spec("world", 1000);
    predicted.spec.gains = Gains::both(1200, 40);
    double least = HUGE_VAL, most = 0;
    for (double q2 = -45; q2 <= 45; q2 += 5) {
      State<double> pose = robot.start_state();
      pose.q[1] = q2 * std::numbers::pi / 180;
      predict(robot, predicted, pose);
      least = std::min(least, predicted.step_limit);
      most = std::max(most, predicted.step_limit);
    }
    const RunResult below =
        run_automatic(robot, row_spec("world", 1000), 1200, 40, 1 / (0.97 * least));
    const RunResult above =
        run_automatic(robot, row_spec("world", 1000), 1200, 40, 1 / (1.03 * most));
    findings.push_back(
        {"stability",
         fmt::format("{}, world orientation, k = 1200, b = 40: theory allows steps of {:.2f} ms at "
                     "every pose of the motion, and beyond {:.2f} ms at none",
                     robot_words(name), 1e3 * least, 1e3 * most),
         fmt::format("3 % below the first: {} deg; 3 % above the second: {}", words(below.max_deg),
                     above.stable ? words(above.max_deg) + " deg" : "diverges"),
         below.stable && (!above.stable || above.max_deg[0] > 5 * below.max_deg[0])});
  }
}

}  // namespace twinarm
