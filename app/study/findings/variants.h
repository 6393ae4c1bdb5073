// Reproduction of E1 to E4, and variants: optimal gains, matched gains, implicit couplings, held
// forces, and one ablation for each choice of the published law. Names: docs/use/run_the_study.md.
#pragma once

#include "app/study/findings/results.h"
#include "app/support/progress.h"

namespace twinarm {

// E1 to E4 with the chosen calibration, in this order.
std::vector<RunSpec> reproduction_specs(const Calibration& calibration);
// Runs them; `hand` is the motion of E1 and E2.
std::vector<RunResult> run_reproduction(const StudyRobot& robot, const Calibration& calibration,
                                        const OperatorMotion& hand);

std::vector<RunResult> run_variants(const StudyInputs& inputs, const StudyRobot& robot,
                                    const Calibration& calibration, Progress& progress);

// Gains with which joints 1 and 2 have this natural frequency [Hz] and damping ratio, each with its
// own inertia at the start pose: k_i = w^2 I_i, divided by r_i^2 for a spring at radius r_i.
Gains gains_from_frequency(const StudyRobot& robot, const CouplingSpec& coupling,
                           double frequency_hz, double damping_ratio);

// obstacle.cpp: automatic motion into a box that stops the DVR, while the KVR passes through it:
// with the couplings of E4 and E3, and with an implicit linear one beyond the limit of R_K / r.
std::vector<ObstacleRun> run_obstacles(const StudyInputs& inputs, const StudyRobot& robot,
                                       const Calibration& calibration);

// Intervals with a contact force; gaps shorter than this [s] are bridged.
std::vector<std::pair<double, double>> contact_intervals(const ObstacleRun& run, double gap);

const RunResult* find_run(const std::vector<RunResult>& runs, const std::string& name);

}  // namespace twinarm
