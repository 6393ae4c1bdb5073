// The answer to the paper's question, each sentence with its numbers. What is said follows from the
// numbers, so that it stays true when the settings change.
#include <fmt/format.h>

#include <cmath>

#include "app/study/findings/findings.h"
#include "app/study/findings/variants.h"

namespace twinarm {
namespace {

using Pair = std::array<double, 2>;

double worst(const Pair& p) {
  return std::max(p[0], p[1]);
}

// "better", "no better" or "about as well", by the larger of the two maxima.
const char* verdict(const Pair& linear, const Pair& torsional) {
  const double ratio = worst(torsional) / worst(linear);
  return ratio > 1.1 ? "better" : ratio < 0.9 ? "worse" : "about as well";
}

// Ratio of the squared natural frequencies.
double spread(const RunResult& result) {
  return std::pow(result.frequency[1] / result.frequency[0], 2);
}

std::string table_line(const StudyResults& results) {
  const RunResult& e3 = *find_run(results.reproduction, "E3");
  const RunResult& e4 = *find_run(results.reproduction, "E4");
  const double error = std::max(worst_relative_error(e3, paper_table().at("E3")),
                                worst_relative_error(e4, paper_table().at("E4")));
  return fmt::format(
      "At one rate of {:g} Hz the printed laws give all eight published numbers of E3 and E4 to "
      "within {:.0f} %: E3 {} deg (published 16.6/23.5), E4 {} deg (3.4/6.0).",
      e3.spec.rate, std::ceil(100 * error), words(e3.max_deg), words(e4.max_deg));
}

std::string question_line(const StudyResults& results) {
  const ProtocolErrors& torsional = results.rows.at("row/findings_10_14/world/60");
  const ProtocolErrors& linear = results.rows.at("row/findings_10_14/linear/60");
  const RunResult& s103_torsional = *find_run(results.variants, "trial/signed-torsional/60");
  const RunResult& s103_linear = *find_run(results.variants, "trial/printed-linear/60");
  return fmt::format(
      "Does linear hold better? With one k and b for both links at 60 Hz it depends on where the "
      "springs sit: uniform arms, springs at the centres of mass: linear {} against torsional {} "
      "deg, {}; the S-103, springs at the arms' ends: {} against {} deg, {}.",
      words(linear.max_deg), words(torsional.max_deg), verdict(linear.max_deg, torsional.max_deg),
      words(s103_linear.max_deg), words(s103_torsional.max_deg),
      verdict(s103_linear.max_deg, s103_torsional.max_deg));
}

std::string reason_line(const StudyResults& results) {
  const RunResult& torsional = *find_run(results.variants, "trial/signed-torsional/60");
  const RunResult& linear = *find_run(results.variants, "trial/printed-linear/60");
  return fmt::format(
      "Why: the fastest mode sets the largest stable step, the slowest one the error, so equal "
      "gains are judged by the spread of the squared frequencies: {:.1f} torsional against {:.1f} "
      "linear "
      "on the S-103; springs at the centres of mass, stiff as the masses, spread them least.",
      spread(torsional), spread(linear));
}

std::string damper_line(const StudyResults& results) {
  const RunResult& printed = *find_run(results.variants, "trial/printed-torsional/60");
  const RunResult& mended = *find_run(results.variants, "trial/signed-torsional/60");
  return fmt::format(
      "The printed torsional damper takes an unsigned angle and cannot dissipate: at 60 Hz its "
      "best is {} deg, mean {}; with a signed damper {} deg, mean {}.",
      words(printed.max_deg), words(printed.mean_deg), words(mended.max_deg),
      words(mended.mean_deg));
}

std::string law_line(const StudyResults& results) {
  const RunResult& matched = *find_run(results.variants, "matched/torsional/60");
  const RunResult& linear = *find_run(results.variants, "matched/linear/60");
  const RunResult& implicit_t = *find_run(results.variants, "implicit/torsional-world/1000");
  const RunResult& implicit_l = *find_run(results.variants, "implicit/linear/1000");
  return fmt::format(
      "It is not the law: with the full stiffness of the linear coupling a torsional one errs by "
      "{} deg, the linear one by {}; implicit at 1 kHz torsional {} deg, linear {} deg.",
      words(matched.max_deg), words(linear.max_deg), words(implicit_t.max_deg),
      words(implicit_l.max_deg));
}

}  // namespace

std::vector<std::string> answer_in_words(const StudyResults& results) {
  return {table_line(results), question_line(results), reason_line(results), damper_line(results),
          law_line(results)};
}

}  // namespace twinarm
