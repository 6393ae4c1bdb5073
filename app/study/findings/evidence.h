// Fits of Table 2 weighed against everything that the paper says of their coupling: four numbers,
// two figures, and the numbers of the user motion with the same gains. Table 2 alone does not tell
// a stiff, ringing coupling from a soft, overdamped one.
#pragma once

#include <string>
#include <vector>

#include "app/study/findings/results.h"
#include "app/support/progress.h"

namespace twinarm {

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

}  // namespace twinarm
