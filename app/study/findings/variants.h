// What is run beside the reproduction: gains by trial, matched gains, implicit couplings, held
// forces, and one ablation for each choice of the printed law. Names: docs/use/run_the_study.md.
#pragma once

#include "app/study/findings/results.h"
#include "app/support/progress.h"

namespace twinarm {

// E1 to E4 with the chosen calibration, in this order; not run.
std::vector<RunSpec> reproduction_specs(const Calibration& calibration);
// The same, run; `hand` moves E1 and E2.
std::vector<RunResult> run_reproduction(const StudyRobot& robot, const Calibration& calibration,
                                        const OperatorMotion& hand);

std::vector<RunResult> run_variants(const StudyInputs& inputs, const StudyRobot& robot,
                                    const Calibration& calibration, Progress& progress);

// Gains that give joints 1 and 2 this natural frequency [Hz] and damping ratio, each on its own
// inertia at the start pose: k_i = w^2 I_i, divided by r_i^2 for a spring at radius r_i.
Gains gains_from_frequency(const StudyRobot& robot, const CouplingSpec& coupling,
                           double frequency_hz, double damping_ratio);

// obstacle.cpp: the automatic motion with a box in the way; the DVR stops at it, the KVR goes on
// through it. One coupling, linear or torsional (world), implicit at the obstacle's rate.
ObstacleRun run_obstacle(const StudyInputs& inputs, const StudyRobot& robot,
                         CouplingSpec::Type type);

const RunResult* find_run(const std::vector<RunResult>& runs, const std::string& name);

}  // namespace twinarm
