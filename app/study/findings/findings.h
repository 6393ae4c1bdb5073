// Claims about the paper's numbers, checked again in this run (docs/understand/paper_analysis.md),
// and the answer to its question.
#pragma once

#include "app/study/findings/results.h"

namespace twinarm {

// ---- variants.cpp, obstacle.cpp ----
//
// Reproduction of E1 to E4, and variants: optimal gains, matched gains, implicit couplings, held
// forces, and one ablation for each choice of the published law. Names: docs/use/run_the_study.md.

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

// Automatic motion into a box that stops the DVR, while the KVR passes through it:
// with the couplings of E4 and E3, and with an implicit linear one beyond the limit of R_K / r.
std::vector<ObstacleRun> run_obstacles(const StudyInputs& inputs, const StudyRobot& robot,
                                       const Calibration& calibration);

// Intervals with a contact force; gaps shorter than this [s] are bridged.
std::vector<std::pair<double, double>> contact_intervals(const ObstacleRun& run, double gap);

const RunResult* find_run(const std::vector<RunResult>& runs, const std::string& name);

// ---- evidence.cpp ----
//
// Fits of Table 2 weighed against everything that the paper says of their coupling: four numbers,
// two figures, and the numbers of the user motion with the same gains. Table 2 alone does not tell
// a stiff, ringing coupling from a soft, overdamped one.

inline constexpr unsigned kEvidenceOperators = 20;  // of the user motion of each fit

// All fits of torsional couplings to E3 and of linear ones to E4, and to the text on E4; first of
// each row the one that the study uses. Requires the identifications and the calibration.
std::vector<Evidence> weigh_evidence(const StudyInputs& inputs, const StudyResults& results,
                                     Progress& progress);

// The share of a statement in a run, 0 to 1; the smaller one of both joints.
double share_of(PaperStatement::Share share, const TrackingSeries& series);
const PaperStatement& statement_on(const std::string& run);

// Fits of the row that agree with its numbers and that the statement on its figure does not
// contradict (that on the user motion is shown only: the operators move otherwise than the
// paper's); the best first: most numbers of the user motion, then fewest parameters, then smallest
// misfit.
std::vector<const Evidence*> remaining(const std::vector<Evidence>& all, const std::string& row);
// Sentence of the answer on a row.
std::string evidence_in_words(const std::vector<Evidence>& all, const std::string& row);

// ---- ensemble.cpp ----
//
// E1 and E2 with many synthetic operators: the distribution of each number of Table 2, and where
// the published number lies in it. The paper's operator was not recorded; one draw of an operator
// says little.

// E1 and E2 with the operators of the settings, from `seed` on, on all processors.
std::vector<Ensemble> run_ensembles(const StudyInputs& inputs, const StudyRobot& robot,
                                    const Calibration& calibration, unsigned seed,
                                    Progress& progress);

// Distribution of the values; `published` may be any number.
Distribution distribution_of(std::vector<double> values, double published);

// ---- findings.cpp, answer.cpp ----

// Fills results.findings and results.rows; requires the runs.
void derive_findings(const StudyInputs& inputs, StudyResults& results, Progress& progress);
// Numbers of both joints, three digits: "1.23/4.56".
std::string words(const std::array<double, 2>& p);
// The answer in one sentence, then the others, each with its conclusion in its first sentence.
// Requires the runs and the findings.
std::vector<std::string> answer_in_words(const StudyResults& results);

// ---- parts of findings.cpp ----

// An entry of assets/study/predictions.toml, made before the run. Throws InputError if it is
// missing.
const Value& entry_of(const Value& predictions, const char* key);

// claims.cpp: equal gains, and gains for which the two couplings are equivalent.
void add_equal_gains(const StudyInputs& inputs, const Value& predictions,
                     std::vector<Finding>& findings);
void add_matched_gains(const StudyResults& results, std::vector<Finding>& findings);
// Maxima within 0.1 degree or 10 % of the linear coupling's.
bool have_equal_errors(const RunResult& linear, const RunResult& torsional);

// Signs and differences of the damping term, and the largest stable step.
void add_damping(const StudyInputs& inputs, std::vector<Finding>& findings);
void add_differences(const StudyInputs& inputs, const StudyResults& results,
                     std::vector<Finding>& findings);
void add_stability(const StudyInputs& inputs, std::vector<Finding>& findings);

// findings.cpp
bool is_near(double measured, double predicted, double relative);
// Automatic motion of a two-link robot with one k and b.
RunResult run_automatic(const StudyRobot& robot, RunSpec spec, double k, double b, double rate);
inline constexpr const char* kTwoLinkRobots[] = {"findings_set0", "findings_10_14"};
// Of "ROBOT/LAW/RATE" and the like: what its parts mean, "linear, as published".
std::string run_words(const std::string& name);

}  // namespace twinarm
