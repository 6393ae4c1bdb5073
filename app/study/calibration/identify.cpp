#include "app/study/calibration/calibration.h"

#include <fmt/format.h>

#include "app/support/parallel_for.h"
#include "app/support/text.h"
#include "solver/linear_algebra/dense_algebra.h"

namespace twinarm {
namespace {

constexpr unsigned kIdentifySeed = 1;
constexpr int kFirstEvaluations = 3000, kRefitEvaluations = 100, kRounds = 3;
// Fixed values of a profile, as factors of the best one; each refit starts from its neighbour.
constexpr std::array<double, 5> kFactors{1.1, 1.3, 2, 4, 10};

// Gains of welds at the points of the linear springs, at the start pose.
Gains weld_gains(const StudyRobot& robot, const CouplingSpec& weld) {
  std::vector<Spring> springs = robot.springs({});
  for (Spring& spring : springs)
    spring = weld_spring(spring.name, robot.dvr_model(weld.type), robot.start_state(), spring.body,
                         spring.p_L, weld.reference);
  return {springs[0].k, springs[0].b, springs[1].k, springs[1].b};
}

// Identification of the parameters of one law at one rate from one row.
struct IdentificationProblem {
  const StudyInputs& inputs;
  const FamilyLaw& law;
  std::string row;
  double rate;

  Identification solve() const {
    Identification found;
    found.row = row;
    found.law = law.name;
    found.fit.name = fmt::format("{}/{}/{:g}", row, law.name, rate);
    found.fit.rate = rate;
    found.fit.parameters = parameters();
    const bool folds = law.coupling.printed && law.coupling.type == CouplingSpec::Type::torsional;
    minimise(found.fit, folds ? Method::rugged : Method::multistart, kIdentifySeed,
             kFirstEvaluations, [this](const CalibrationEntry& entry) { return misfit(entry); });
    // If a profile finds a better fit, the search is repeated from there.
    for (int round = 0; round < kRounds; ++round) {
      CalibrationEntry better = found.fit;
      found.profiles.clear();
      for (std::size_t j = 0; j < found.fit.parameters.size(); ++j)
        found.profiles.push_back(profile(found.fit, j, better));
      if (better.objective > 0.95 * found.fit.objective || round + 1 == kRounds) break;
      minimise(better, Method::local, kIdentifySeed, kFirstEvaluations / 4,
               [this](const CalibrationEntry& entry) { return misfit(entry); });
      better.evaluations += found.fit.evaluations;
      found.fit = better;
    }
    const RunResult best = run_with(found.fit, 1);
    found.fit.keep(best.max_deg, best.mean_deg);
    // Zeros make the matrix square; the directions that they add have no effect. Four numbers
    // cannot determine five parameters: at least one singular value is zero.
    const auto count = static_cast<Eigen::Index>(found.fit.parameters.size());
    const Eigen::MatrixXd S = sensitivity(found.fit);
    const Eigen::Index size = std::max<Eigen::Index>(S.rows(), count);
    Eigen::MatrixXd square = Eigen::MatrixXd::Zero(size, size);
    square.topLeftCorner(S.rows(), count) = S;
    const SingularValues values = singular_values(square);
    for (Eigen::Index i = 0; i < count; ++i) {
      found.singular_values.push_back(i < S.rows() ? values.values(i) : 0);
      const Eigen::VectorXd v = values.V.col(i).head(count);
      found.directions.emplace_back(v.begin(), v.end());
    }
    return found;
  }

  std::vector<Parameter> parameters() const {
    if (law.coupling.type == CouplingSpec::Type::weld)
      return {{"time_constant", 1e-3, 1, 0},
              {"damping_ratio", 0.01, 10, 0},
              {"arm2_mass_scale", 0.2, 4, 0}};
    const bool points = facts_of(law.coupling.type, law.coupling.printed).at_point;
    const double k_low = points ? 100 : 3, k_high = points ? 1e7 : 3e5;  // [N/m], [N m/rad]
    const double b_low = points ? 0.1 : 3e-3, b_high = points ? 3e4 : 1e3;
    return {{"k1", k_low, k_high, 0},
            {"b1", b_low, b_high, 0},
            {"k2", k_low, k_high, 0},
            {"b2", b_low, b_high, 0},
            {"arm2_mass_scale", 0.2, 4, 0}};
  }

  RunResult run_with(const CalibrationEntry& entry, double sweep) const {
    const FittedRun fitted = fitted_run(inputs, row, law, entry);
    return run(fitted.robot, AutomaticMotion(OperatorMapping{}, sweep), fitted.spec);
  }

  double misfit(const CalibrationEntry& entry) const {
    return std::ranges::max(table_misfits(run_with(entry, 1), row));
  }

  // d x_i / d log theta_j by central differences, in half digits; also beyond the bounds of the
  // search.
  Eigen::MatrixXd sensitivity(const CalibrationEntry& entry) const {
    constexpr double step = 1e-3;
    Eigen::MatrixXd S(4, static_cast<Eigen::Index>(entry.parameters.size()));
    const PaperRow& paper = kPaperTable.at(row);
    const Eigen::Vector4d half_digits(paper.max_half_digit[0], paper.max_half_digit[1],
                                      paper.mean_half_digit[0], paper.mean_half_digit[1]);
    const auto numbers = [&](std::size_t j, double factor) {
      CalibrationEntry moved = entry;
      moved.parameters[j].value *= factor;
      const RunResult r = run_with(moved, 1);
      return Eigen::Vector4d(r.max_deg[0], r.max_deg[1], r.mean_deg[0], r.mean_deg[1]);
    };
    for (std::size_t j = 0; j < entry.parameters.size(); ++j)
      S.col(static_cast<Eigen::Index>(j)) =
          (numbers(j, std::exp(step)) - numbers(j, std::exp(-step)))
              .cwiseQuotient(2 * step * half_digits);
    return S;
  }

  // Fits all other parameters again, from their current values.
  ProfilePoint refit(CalibrationEntry& entry, std::size_t held) const {
    const Parameter fixed = entry.parameters[held];
    CalibrationEntry free = entry;
    free.parameters.erase(free.parameters.begin() + static_cast<std::ptrdiff_t>(held));
    const auto whole = [&](const CalibrationEntry& some) {
      CalibrationEntry all = entry;
      all.parameters = some.parameters;
      all.parameters.insert(all.parameters.begin() + static_cast<std::ptrdiff_t>(held), fixed);
      return all;
    };
    minimise(free, Method::local, kIdentifySeed, kRefitEvaluations,
             [&](const CalibrationEntry& some) { return misfit(whole(some)); });
    entry = whole(free);
    entry.objective = free.objective;
    return {fixed.value, free.objective, run_with(entry, kOtherSweep).max_deg};
  }

  // `better`: best fit among the points of the profile.
  Profile profile(const CalibrationEntry& best, std::size_t held, CalibrationEntry& better) const {
    Profile profile;
    const Parameter& p = best.parameters[held];
    profile.parameter = p.name;
    profile.points.push_back({p.value, best.objective, run_with(best, kOtherSweep).max_deg});
    for (const bool up : {false, true}) {
      CalibrationEntry walker = best;
      for (const double factor : kFactors) {
        check_interrupt();
        const double value = up ? p.value * factor : p.value / factor;
        if (value < p.low || value > p.high) break;
        walker.parameters[held].value = value;
        profile.points.push_back(refit(walker, held));
        if (walker.objective < better.objective) better = walker;
      }
    }
    std::ranges::sort(profile.points, {}, &ProfilePoint::value);
    return profile;
  }
};

}  // namespace

FittedRun fitted_run(const StudyInputs& inputs, const std::string& row, const FamilyLaw& law,
                     const CalibrationEntry& fit) {
  FittedRun fitted{StudyRobot::s103(inputs.settings, inputs.s103, fit.value("arm2_mass_scale")),
                   {}};
  RunSpec& spec = fitted.spec;
  spec.name = row;
  spec.coupling = law.coupling;
  spec.rate = fit.rate;
  if (!law.coupling.printed) spec.kvr_rates = TargetRates::backward_difference;
  if (law.coupling.type == CouplingSpec::Type::weld) {
    spec.coupling.reference.time_constant = fit.value("time_constant");
    spec.coupling.reference.damping_ratio = fit.value("damping_ratio");
    spec.gains = weld_gains(fitted.robot, spec.coupling);
  } else {
    spec.gains = fit.gains();
  }
  return fitted;
}

Identification identify_one(const StudyInputs& inputs, const std::string& problem) {
  DiagnosticList faults;
  const auto fault = [&](std::string what, std::string fix) {
    faults.add("--identify-one", std::move(what), std::move(fix), "study.question");
  };
  const std::vector<std::string> parts = split(problem, '/');
  if (parts.size() != 3) {
    fault("'" + problem + "' is not ROW/LAW/RATE", "for example E4/linear/60");
    faults.check();
  }
  const std::string &row = parts[0], &law = parts[1], &number = parts[2];
  const double rate = parse_number(number).value_or(0);
  const std::vector<std::string> laws = names_of(family_laws());
  if (row != "E3" && row != "E4" && row != "E4-text")
    fault("unknown row '" + row + "'", "E3, E4 or E4-text");
  if (std::ranges::find(laws, law) == laws.end())
    fault("unknown law '" + law + "'", name_remedy(law, laws, "laws"));
  if (!(rate >= 10 && rate <= 1e5)) fault("'" + number + "' is not a rate", "10 to 100000 Hz");
  faults.check();
  return IdentificationProblem{inputs, family_law(law), row, rate}.solve();
}

std::vector<Identification> identify(const StudyInputs& inputs, Progress& progress) {
  std::vector<IdentificationProblem> problems;  // the slow ones first
  std::vector<double> steps{0};                 // simulated steps per second up to each
  std::vector<double> rates = inputs.settings.identification_rates_hz;
  std::sort(rates.rbegin(), rates.rend());
  for (const double rate : rates)
    for (const char* row : {"E3", "E4", "E4-text"})
      for (const FamilyLaw& law : family_laws()) {
        if (row == std::string("E4-text") && !law.fits_row(row)) continue;
        problems.push_back({inputs, law, row, rate});
        steps.push_back(steps.back() + rate);
      }
  std::vector<Identification> found(problems.size());
  progress.stage("identification from Table 2", 1);
  constexpr unsigned kIdentifyWorkers = 2;
  parallel_for(
      problems.size(), [&](std::size_t i) { found[i] = problems[i].solve(); },
      [&](std::size_t done) { progress.advance(steps[done] / steps.back()); }, kIdentifyWorkers);
  return found;
}

}  // namespace twinarm
