// The answer to the paper's question. Each sentence is chosen by the results
// (tests/app/study/findings/test_answer.cpp).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/study/findings/evidence.h"
#include "app/study/findings/findings.h"
#include "app/study/findings/variants.h"

namespace twinarm {
namespace {

using Pair = std::array<double, 2>;

double worst(const Pair& p) {
  return std::max(p[0], p[1]);
}

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
  const double ratio = worst(torsional) / worst(linear);
  return ratio > 1.1 ? "smaller" : ratio < 0.9 ? "larger" : "about equal";
}

// Maxima of uniform arms with springs at the centres of mass, and of the S-103 with springs at the
// ends of the arms.
struct Positions {
  Pair uniform_linear, uniform_torsional, linear, torsional;
  std::string uniform() const { return verdict(uniform_linear, uniform_torsional); }
  std::string s103() const { return verdict(linear, torsional); }
};

std::string headline(const Positions& p, bool equal_errors) {
  return fmt::format("{}; with the same joint stiffness their errors {}.",
                     p.uniform() != p.s103()
                         ? "Whether linear or torsional springs have the smaller tracking error "
                           "depends on where they act"
                     : p.s103() == "smaller"
                         ? "Linear springs have a smaller tracking error than torsional ones"
                         : "Linear springs have no smaller tracking error than torsional ones",
                     equal_errors ? "agree within 10 %" : "differ");
}

std::string comparison(const Positions& p) {
  const std::string answer =
      p.uniform() != p.s103()
          ? "Which coupling has the smaller errors depends on the position of the springs"
      : p.s103() == "smaller"
          ? "The linear coupling has the smaller errors with both positions of the springs"
          : "The linear coupling has the smaller errors with neither position of the springs";
  return fmt::format(
      "{}. With one k and b for both links at 60 Hz, uniform arms, springs at the centres of mass: "
      "linear {} against torsional {} deg, {}; "
      "S-103, springs at the ends of the arms: {} against {} deg, {}.",
      answer, words(p.uniform_linear), words(p.uniform_torsional), p.uniform(), words(p.linear),
      words(p.torsional), p.s103());
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
  const double ratio = worst(printed.max_deg) / worst(torsional.max_deg);
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
      "deg, "
      "of the linear one {}; implicit at 1 kHz torsional {} deg, linear {} deg.",
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
  const Positions positions{results.rows.at("row/findings_10_14/linear/60").max_deg,
                            results.rows.at("row/findings_10_14/world/60").max_deg,
                            variant("trial/printed-linear/60").max_deg, torsional.max_deg};
  return {headline(positions, have_equal_errors(equal_linear, equal_torsional)),
          reproduction(results.reproduction[2], results.reproduction[3]),
          operators(results.ensembles),
          comparison(positions),
          reason(results.orders),
          damper(variant("trial/printed-torsional/60"), torsional),
          matched(equal_torsional, equal_linear, variant("implicit/torsional-world/1000"),
                  variant("implicit/linear/1000")),
          evidence_in_words(results.evidence, "E3"),
          evidence_in_words(results.evidence, "E4")};
}

}  // namespace twinarm
