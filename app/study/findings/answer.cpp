// The answer to the paper's question. Each sentence is chosen by the results
// (tests/app/study/findings/test_answer.cpp).
#include <fmt/format.h>

#include "app/study/findings/findings.h"

namespace twinarm {
namespace {

using Pair = std::array<double, 2>;

std::string reproduction(const RunResult& e3, const RunResult& e4) {
  const double error = std::max(worst_relative_error(e3), worst_relative_error(e4));
  return fmt::format(
      "The published laws {} the eight published numbers of E3 and E4 within 15 % (largest "
      "deviation {:.0f} %). At {:g} Hz for both: E3 {} deg (published {}), E4 {} deg ({}).",
      error <= 0.15 ? "reproduce" : "do not reproduce", std::ceil(100 * error), e3.spec.rate,
      words(e3.max_deg), words(kPaperTable.at("E3").max_deg), words(e4.max_deg),
      words(kPaperTable.at("E4").max_deg));
}

std::string operators(const std::vector<Ensemble>& ensembles) {
  std::size_t inside = 0, numbers = 0;  // published numbers in the band of the operators
  for (const Ensemble& all : ensembles)
    for (const auto* row : {&all.max_deg, &all.mean_deg})
      for (const Distribution& number : *row) {
        inside += number.is_inside();
        ++numbers;
      }
  const Ensemble &e1 = ensembles.at(0), &e2 = ensembles.at(1);
  const auto medians = [](const std::array<Distribution, 2>& d) {
    return words({d[0].median, d[1].median});
  };
  return fmt::format(
      "Of E1 and E2, {} of the {} published numbers lie between the 10 % and the 90 % quantile of "
      "synthetic operators. With the same gains and {} operators the medians of the maxima are {} "
      "and {} deg (published {} and {}).",
      inside, numbers, e1.seeds, medians(e1.max_deg), medians(e2.max_deg),
      words(kPaperTable.at(e1.name).max_deg), words(kPaperTable.at(e2.name).max_deg));
}

// Larger of the two maxima, linear against torsional.
const char* verdict(const Pair& linear, const Pair& torsional) {
  const double ratio = std::ranges::max(torsional) / std::ranges::max(linear);
  return ratio > 1.1 ? "smaller" : ratio < 0.9 ? "larger" : "about equal";
}

// Of uniform arms with springs at the centres of mass, and the S-103 with springs at the ends of
// the arms.
std::string effect_of_position(const std::string& uniform, const std::string& s103) {
  if (uniform != s103)
    return "Whether linear or torsional springs have the smaller tracking error depends on where "
           "they act";
  return s103 == "smaller" ? "Linear springs have the smaller tracking error, wherever they act"
                           : "Linear springs do not have the smaller tracking error";
}

std::string comparison(const Pair& uniform_linear, const Pair& uniform_torsional,
                       const Pair& linear, const Pair& torsional) {
  const std::string uniform = verdict(uniform_linear, uniform_torsional);
  const std::string s103 = verdict(linear, torsional);
  return fmt::format(
      "{}. One k and b for both links, 60 Hz, linear against torsional: uniform arms, springs at "
      "the centres of mass: {} against {} deg, {}; S-103, springs at the ends of the arms: {} "
      "against {} deg, {}.",
      effect_of_position(uniform, s103), words(uniform_linear), words(uniform_torsional), uniform,
      words(linear), words(torsional), s103);
}

std::string reason(const std::vector<CouplingOrder>& orders) {
  std::size_t predicted = 0;
  std::string others;
  for (const CouplingOrder& o : orders) {
    predicted += o.is_predicted();
    if (!o.is_predicted())
      others +=
          fmt::format("{}{}, {:g} Hz, linear {} (predicted {:.3g}), torsional {} ({:.3g})",
                      others.empty() ? " Not in: " : "; ", o.robot, o.rate, words(o.linear_deg),
                      o.linear_peak_deg, words(o.torsional_deg), o.torsional_peak_deg);
  }
  const double share = static_cast<double>(predicted) / static_cast<double>(orders.size());
  return fmt::format(
      "{} by linear theory, in the worst pose of the motion, predicts which coupling has the "
      "smaller errors in {} of {} rows.{}{}",
      share > 0.8 ? "Reason: the step and the fastest mode limit the gains; then the slow mode "
                    "determines the peak after a reversal. This peak"
                  : "No reason found: the peak after a reversal",
      predicted, orders.size(), others, others.empty() ? "" : " deg.");
}

std::string damper(const RunResult& printed, const RunResult& torsional) {
  const double ratio = std::ranges::max(printed.max_deg) / std::ranges::max(torsional.max_deg);
  return fmt::format(
      "The published torsional damper uses an unsigned angle: {}. With optimal gains at 60 Hz {} "
      "deg, mean {}; with a signed damper {} deg, mean {}.",
      ratio > 1.1   ? fmt::format("its largest error is {:.1f} times that of a signed one", ratio)
      : ratio < 0.9 ? "a signed one has larger errors"
                    : "that does not change the largest error by more than 10 %",
      words(printed.max_deg), words(printed.mean_deg), words(torsional.max_deg),
      words(torsional.mean_deg));
}

std::string matched(const RunResult& torsional, const RunResult& linear,
                    const RunResult& torsional_1000, const RunResult& linear_1000) {
  return fmt::format(
      "{}. With the full stiffness of the linear coupling the errors of a torsional one are {} "
      "deg, of the linear one {}; implicit at 1 kHz torsional {} deg, linear {} deg.",
      have_equal_errors(linear, torsional)
          ? "The law is not the reason: with the same joint stiffness the errors agree within 10 %"
          : "The law is a reason of its own: with the same joint stiffness the errors differ",
      words(torsional.max_deg), words(linear.max_deg), words(torsional_1000.max_deg),
      words(linear_1000.max_deg));
}

}  // namespace

std::vector<std::string> answer_in_words(const StudyResults& results) {
  const auto variant = [&](const char* name) -> const RunResult& {
    return *find_run(results.variants, name);
  };
  const RunResult& torsional = variant("trial/signed-torsional/60");
  const RunResult &equal_torsional = variant("matched/torsional/60"),
                  &equal_linear = variant("matched/linear/60");
  const std::string position =
      comparison(results.rows.at("row/findings_10_14/linear/60").max_deg,
                 results.rows.at("row/findings_10_14/world/60").max_deg,
                 variant("trial/printed-linear/60").max_deg, torsional.max_deg);
  return {fmt::format(
              "{}; with the same joint stiffness their errors {}.",
              position.substr(0, position.find(". ")),
              have_equal_errors(equal_linear, equal_torsional) ? "agree within 10 %" : "differ"),
          reproduction(results.reproduction[2], results.reproduction[3]),
          operators(results.ensembles),
          position,
          reason(results.orders),
          damper(variant("trial/printed-torsional/60"), torsional),
          matched(equal_torsional, equal_linear, variant("implicit/torsional-world/1000"),
                  variant("implicit/linear/1000")),
          evidence_in_words(results.evidence, "E3"),
          evidence_in_words(results.evidence, "E4")};
}

}  // namespace twinarm
