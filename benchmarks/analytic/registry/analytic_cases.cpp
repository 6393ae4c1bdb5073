#include "benchmarks/analytic/registry/analytic_cases.h"
#include "benchmarks/analytic/contact/contact_cases.h"
#include "benchmarks/analytic/coupling/coupling_cases.h"
#include "benchmarks/analytic/integrators/integrator_cases.h"
#include "benchmarks/analytic/joints/smooth_cases.h"
#include "benchmarks/analytic/loops/loop_runs.h"
#include "benchmarks/analytic/registry/engine_tasks.h"
#include "benchmarks/analytic/support/run_trajectory.h"

namespace twinarm {

// A new family of cases is one more line here.
const std::vector<AnalyticCase>& analytic_cases() {
  static const std::vector<AnalyticCase> all = [] {
    using namespace contact_cases;
    using namespace smooth_cases;
    std::vector<AnalyticCase> cases;
    for (const auto& family : {
             symmetric_body(),
             asymmetric_body(),
             heavy_top(),
             floating_tree(),
             pendulum(),
             compound_pendulum(),
             sliding_joints(),
             oscillators(),
             spherical_pendulum(),
             universal_joint(),
             double_pendulum(),
             hanging_chain(),
             cart_pole(),
             kapitza(),
             crossed_hinges(),
             loop_runs(),
             loop_ends(),
             impacts(),
             sliding(),
             toppling(),
             rolling(),
             painleve(),
             spinning(),
             stacks(),
             hollows(),
             arches(),
             wedges(),
             rod_impacts(),
             puma560_robot(),
             planar_arm(),
             coupling_tracking(),
             coupling_stability(),
             golden_pendulum(),
             integrators(),
             engine_tasks::cases(),
         })
      cases.insert(cases.end(), family.begin(), family.end());
    return cases;
  }();
  return all;
}

const std::vector<SkippedCase>& skipped_cases() {
  static const std::vector<SkippedCase> all = {
      {"D8", "loops",
       "the rectangular Bricard: neither its data nor reference values are published; see D4"},
      {"E14-capstan", "contact", "optional: friction of a belt needs a rope of many contacts"},
      {"E15", "contact", "optional: a silo needs many thousand grains"},
      {"F5", "robots",
       "the iiwa's parameters are those of a URDF that is not part of this program"},
      {"H1-anymal", "engines", "the model of the robot is not part of this program"},
      {"H2", "engines", "the models of hand and humanoid are not published with the numbers"},
      {"H3", "engines", "a list of what other engines test, not a case"},
  };
  return all;
}

CaseResult run_case(const AnalyticCase& c) {
  if (!c.trajectory) return c.run();
  const LaneResult result = run_lane(*c.trajectory, c.trajectory->lane);
  return {result.error, result.energy_drift, observed_order(*c.trajectory, c.trajectory->lane)};
}

}  // namespace twinarm
