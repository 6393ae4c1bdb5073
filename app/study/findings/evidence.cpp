
#include <fmt/format.h>

#include "app/study/findings/findings.h"
#include "app/support/parallel_for.h"

namespace twinarm {
namespace {

struct Fit {
  Evidence evidence;
  StudyRobot robot;
  RunSpec spec;
};

// Times at which the angle has an extreme from which it returns by more than `least`, and the
// start.
std::vector<double> reversals(const std::vector<double>& t, const std::vector<double>& q,
                              double least) {
  std::vector<double> times{t.front()};
  std::size_t low = 0, high = 0;
  int direction = 0;  // of the motion since the last extreme
  for (std::size_t n = 1; n < q.size(); ++n) {
    if (q[n] > q[high]) high = n;
    if (q[n] < q[low]) low = n;
    const bool falls = q[high] - q[n] > least, rises = q[n] - q[low] > least;
    if (direction >= 0 && falls) {
      if (direction > 0) times.push_back(t[high]);
      direction = -1;
      low = n;
    } else if (direction <= 0 && rises) {
      if (direction < 0) times.push_back(t[low]);
      direction = 1;
      high = n;
    }
  }
  return times;
}

double share_near_reversals(const TrackingSeries& s, std::size_t joint) {
  constexpr double kAfter = 0.25, kLeast = 2 * kDegree;  // [s], [rad]
  const std::vector<double> times = reversals(s.t, s.q_K[joint], kLeast);
  double near = 0, far = 0, near_count = 0, far_count = 0;
  for (std::size_t n = 0; n < s.t.size(); ++n) {
    const double e = std::abs(s.q_K[joint][n] - s.q_D[joint][n]);
    const auto next = std::ranges::upper_bound(times, s.t[n]);
    const bool is_near = next != times.begin() && s.t[n] - *std::prev(next) <= kAfter;
    (is_near ? near : far) += e;
    ++(is_near ? near_count : far_count);
  }
  near /= std::max(near_count, 1.0);
  far /= std::max(far_count, 1.0);
  return near + far > 0 ? near / (near + far) : 0;
}

double share_of_offset(const TrackingSeries& s, std::size_t joint) {
  double in_sweep = 0, offset = 0, all = 0;
  for (std::size_t n = 0; n < s.t.size(); ++n) {
    const double e = s.q_K[joint][n] - s.q_D[joint][n];
    if (n > 0 && std::floor(s.t[n] + 1e-9) > std::floor(s.t[n - 1] + 1e-9)) {
      offset += std::abs(in_sweep);
      in_sweep = 0;
    }
    in_sweep += e;
    all += std::abs(e);
  }
  offset += std::abs(in_sweep);
  return all > 0 ? offset / all : 0;
}

Fit used_in_study(const StudyInputs& inputs, const StudyResults& results, const RunSpec& spec) {
  const Calibration& c = results.calibration;
  const CalibrationEntry& entry = spec.name == "E3" ? c.e3("world-", spec.rate) : c.e4(spec.rate);
  Fit fit{{}, StudyRobot::s103(inputs.settings, inputs.s103, results.arm2_mass_scale), spec};
  fit.evidence.law = coupling_words(spec.coupling) + ", as published, one k and b";
  if (spec.name == "E4") fit.evidence.law = "linear, as published";
  fit.evidence.parameters = static_cast<int>(entry.parameters.size());
  fit.evidence.arm2_mass_scale = results.arm2_mass_scale;
  fit.evidence.is_used = true;
  return fit;
}

std::vector<Fit> fits(const StudyInputs& inputs, const StudyResults& results) {
  std::vector<Fit> all;
  const std::vector<RunSpec> used = reproduction_specs(results.calibration);
  for (const char* row : {"E3", "E4", "E4-text"}) {
    for (const RunSpec& spec : used)
      if (spec.name == row) all.push_back(used_in_study(inputs, results, spec));
    for (const Identification& found : results.identifications) {
      const FamilyLaw& law = family_law(found.law);
      if (found.row != row || !law.fits_row(row)) continue;
      auto [robot, spec] = fitted_run(inputs, row, law, found.fit);
      Fit fit{{}, std::move(robot), std::move(spec)};
      fit.evidence.law = law.words;
      fit.evidence.parameters = static_cast<int>(found.fit.parameters.size());
      fit.evidence.arm2_mass_scale = found.fit.value("arm2_mass_scale");
      all.push_back(std::move(fit));
    }
  }
  for (Fit& fit : all) {
    fit.evidence.row = fit.spec.name;
    fit.evidence.rate = fit.spec.rate;
    fit.evidence.gains = fit.spec.gains;
  }
  return all;
}

void weigh_automatic(Fit& fit) {
  Evidence& e = fit.evidence;
  RunResult result = run(fit.robot, AutomaticMotion(OperatorMapping{}), fit.spec);
  predict(fit.robot, result, fit.robot.start_state());
  e.damping_ratio = result.damping_ratio;
  e.misfit = table_misfits(result, e.row);
  e.figure = share_of(statement_on(e.row).share, result.series);
}

void weigh_by_user(const StudyInputs& inputs, Fit& fit) {
  const StudySettings& s = inputs.settings;
  const std::string row = fit.evidence.user_row();
  const std::array<double, 4> published = numbers_of(kPaperTable.at(row));
  std::vector<double> shares;
  std::array<std::vector<double>, 4> numbers;
  for (unsigned n = 0; n < kEvidenceOperators; ++n) {
    const SyntheticOperator hand(s.seed + n, s.operator_duration, s.operator_ranges);
    const RunResult result = run(fit.robot, hand, fit.spec);
    shares.push_back(share_of(statement_on(row).share, result.series));
    for (std::size_t i = 0; i < 4; ++i)
      numbers[i].push_back(result.stable ? numbers_of(result)[i] : HUGE_VAL);
  }
  fit.evidence.user_figure = distribution_of(shares, 0).median;
  for (std::size_t i = 0; i < 4; ++i)
    fit.evidence.user_numbers += distribution_of(numbers[i], published[i]).is_inside();
}

// Whether the readings oscillate, by the damping ratio of their slow mode.
std::string kind_words(const std::vector<const Evidence*>& left) {
  double low = HUGE_VAL, high = 0;
  for (const Evidence* e : left) {
    low = std::min(low, e->damping_ratio[0]);
    high = std::max(high, e->damping_ratio[0]);
  }
  return fmt::format("{} (damping ratio of the slow mode {:.2g} to {:.2g})",
                     low > 1    ? "All overdamped"
                     : high < 1 ? "All oscillating"
                                : "Some oscillating, some overdamped",
                     low, high);
}

}  // namespace

bool Evidence::is_contradicted() const {
  return verdict_of(statement_on(row), figure) == Verdict::contradicts;
}

const PaperStatement& statement_on(const std::string& run) {
  return *std::ranges::find(kPaperStatements, run.substr(0, 2),
                            [](const PaperStatement& s) { return std::string(s.run); });
}

double share_of(PaperStatement::Share share, const TrackingSeries& series) {
  if (share == PaperStatement::Share::offset_of_joint2) return share_of_offset(series, 1);
  return std::min(share_near_reversals(series, 0), share_near_reversals(series, 1));
}

std::vector<Evidence> weigh_evidence(const StudyInputs& inputs, const StudyResults& results,
                                     Progress& progress) {
  std::vector<Fit> all = fits(inputs, results);
  parallel_for(
      all.size(),
      [&](std::size_t n) {
        weigh_automatic(all[n]);
        weigh_by_user(inputs, all[n]);
      },
      [&](std::size_t done) { progress.advance(done, all.size()); });
  std::vector<Evidence> evidence;
  for (const Fit& fit : all) evidence.push_back(fit.evidence);
  return evidence;
}

std::vector<const Evidence*> remaining(const std::vector<Evidence>& all, const std::string& row) {
  std::vector<const Evidence*> found;
  for (const Evidence& e : all)
    if (e.row == row && e.has_numbers() && !e.is_contradicted()) found.push_back(&e);
  std::ranges::stable_sort(found, {}, [](const Evidence* e) {
    return std::tuple(-e->user_numbers, e->parameters, std::ranges::max(e->misfit));
  });
  return found;
}

std::string evidence_in_words(const std::vector<Evidence>& all, const std::string& row) {
  std::size_t readings = 0, agree = 0;
  const Evidence* used = nullptr;
  for (const Evidence& e : all) {
    if (e.row != row) continue;
    ++readings;
    agree += e.has_numbers();
    if (e.is_used) used = &e;
  }
  const std::vector<const Evidence*> left = remaining(all, row);
  const PaperStatement& figure = statement_on(row);
  std::string words = fmt::format(
      "Of {} readings of {} (law, rate, gains, mass), {} agree with its four numbers, and {} of "
      "these {} not contradicted by what the paper says of Figure {}",
      readings, row, agree, left.size(), left.size() == 1 ? "is" : "are", figure.figure);
  if (!left.empty())
    words += fmt::format(". {}; nearest to {} is {} at {:g} Hz, with {} of its 4 numbers",
                         kind_words(left), used->user_row(), left.front()->law, left.front()->rate,
                         left.front()->user_numbers);
  words += fmt::format(
      ". The reading used here, as published, has {} of 4 numbers of {}; Figure {} {} (share "
      "{:.2f}).",
      used->user_numbers, used->user_row(), figure.figure,
      verdict_words(verdict_of(figure, used->figure)), used->figure);
  return words;
}

}  // namespace twinarm
