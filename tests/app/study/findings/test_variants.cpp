#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <set>

#include "app/study/findings/findings.h"

using namespace twinarm;

namespace {

struct Study {
  StudyInputs inputs = load_inputs(TWINARM_SOURCE_DIR "/assets");
  Calibration calibration = read_calibration(TWINARM_SOURCE_DIR "/assets/study/calibration.json");
  StudyRobot robot = StudyRobot::s103(inputs.settings, inputs.s103,
                                      calibration.entry("chosen").numbers.at("arm2_mass_scale"));
  std::vector<RunResult> variants;
  Study() {
    Progress silent(true);
    variants = run_variants(inputs, robot, calibration, silent);
  }
  const RunResult& variant(const std::string& name) const {
    const RunResult* found = find_run(variants, name);
    REQUIRE_MESSAGE(found, name);
    return *found;
  }
};
const Study& study() {
  static const Study once;
  return once;
}

double error_sum(const RunResult& run) {
  return run.max_deg[0] + run.max_deg[1];
}

}  // namespace

TEST_CASE("the variants are these 72, each once") {
  std::set<std::string> expected, found;
  for (const char* law :
       {"printed-torsional", "signed-torsional", "signed-torsional-ratio", "printed-linear"})
    for (int rate : {30, 60, 120, 250, 1000}) {
      expected.insert(fmt::format("trial/{}/{}", law, rate));
      if (rate < 1000) expected.insert(fmt::format("held/{}/{}-held", law, rate));
    }
  for (const char* law : {"linear", "torsional"})
    for (int rate : {30, 60, 120, 250, 1000})
      expected.insert(fmt::format("matched/{}/{}", law, rate));
  for (const char* scheme : {"explicit", "semi-implicit", "implicit"})
    for (const char* law : {"torsional-world", "torsional-joint", "linear"})
      for (int rate : {60, 1000}) expected.insert(fmt::format("{}/{}/{}", scheme, law, rate));
  for (const char* change : {"signed", "folded", "folded-along", "unsigned", "per-frame", "older",
                             "true-velocities", "ratio-0.2"})
    expected.insert(fmt::format("ablation/{}", change));
  for (const RunResult& run : study().variants) CHECK(found.insert(run.spec.name).second);
  CHECK(found == expected);
  CHECK(found.size() == 72);
}

TEST_CASE("no two variants run alike, but for the ablations that repeat a trial") {
  for (const RunResult& a : study().variants)
    for (const RunResult& b : study().variants) {
      if (!(a.spec.name < b.spec.name) || !a.stable || !b.stable) continue;
      const bool repeated =
          (a.spec.name == "ablation/signed" && b.spec.name == "trial/signed-torsional/60") ||
          (a.spec.name == "ablation/ratio-0.2" && b.spec.name == "trial/signed-torsional-ratio/60");
      CAPTURE(a.spec.name);
      CAPTURE(b.spec.name);
      CHECK((std::abs(error_sum(a) - error_sum(b)) < 1e-9 * error_sum(a)) == repeated);
    }
}

TEST_CASE("a held force acts for several steps of the physics, and lowers the stability limit") {
  for (const RunResult& run : study().variants) {
    CAPTURE(run.spec.name);
    if (!run.spec.name.starts_with("held/")) {
      CHECK(run.spec.held_substeps == 1);
      continue;
    }
    CHECK(run.spec.step() == doctest::Approx(1e-3).epsilon(0.1));
    CHECK(run.spec.step() * run.spec.held_substeps == doctest::Approx(run.interval()));
    RunResult unheld;
    unheld.spec = run.spec;
    unheld.spec.held_substeps = 1;
    predict(study().robot, unheld, study().robot.start_state());
    CHECK(run.step_limit < unheld.step_limit);
    const std::vector<double>& force = run.series.coupling_force.at(0);
    std::size_t changes = 0;
    for (std::size_t n = 1; n < force.size(); ++n) changes += force[n] != force[n - 1];
    CHECK(changes <= force.size() / static_cast<std::size_t>(run.spec.held_substeps) + 2);
    // The finer physics with a force computed in each of its steps is stable.
    RunResult fine;
    fine.spec = run.spec;
    fine.spec.held_substeps = 1;
    fine.spec.rate = 1 / run.spec.step();
    const AutomaticMotion hand{OperatorMapping{}};
    fine = ::twinarm::run(study().robot, hand, fine.spec);
    CHECK(fine.stable);
    if (run.stable) CHECK(std::abs(error_sum(fine) - error_sum(run)) > 1e-3 * error_sum(run));
  }
}

TEST_CASE("each scheme is stable where linear theory says so, in every pose or in none") {
  for (const RunResult& run : study().variants) {
    const std::string& name = run.spec.name;
    if (!name.starts_with("explicit/") && !name.starts_with("semi-implicit/") &&
        !name.starts_with("implicit/"))
      continue;
    CAPTURE(name);
    const double limit = step_limit_of_motion(study().robot, run.spec);
    if (run.interval() < limit) CHECK(run.stable);
    if (run.interval() > 1.3 * run.step_limit) CHECK_FALSE(run.stable);
    if (name.starts_with("implicit/")) CHECK(std::isinf(limit));
    if (name.starts_with("explicit/") && name.ends_with("/60")) CHECK_FALSE(run.stable);
  }
}

TEST_CASE("matched couplings have one K_q and B_q at the start pose") {
  for (int rate : {30, 60, 120, 250, 1000}) {
    const RunResult& linear = study().variant(fmt::format("matched/linear/{}", rate));
    const RunResult& torsional = study().variant(fmt::format("matched/torsional/{}", rate));
    CHECK(linear.frequency[0] == doctest::Approx(torsional.frequency[0]).epsilon(1e-9));
    CHECK(linear.frequency[1] == doctest::Approx(torsional.frequency[1]).epsilon(1e-9));
    CHECK(linear.spec.coupling.type != torsional.spec.coupling.type);
  }
}

TEST_CASE("each ablation has the effect of its one change") {
  const auto run = [](const char* name) -> const RunResult& {
    return study().variant(std::string("ablation/") + name);
  };
  const RunResult& base = run("signed");
  const auto mean_over_max = [](const RunResult& r) { return r.mean_deg[0] / r.max_deg[0]; };
  for (const char* folded : {"folded", "folded-along"}) CHECK(run(folded).stable);
  // The sign matters to a damper that is not even in the velocity, and only to it.
  CHECK(error_sum(run("folded")) != doctest::Approx(error_sum(run("folded-along"))).epsilon(1e-3));
  // Half of the time the torque of an unsigned speed adds energy: it oscillates on.
  CHECK(run("unsigned").mean_deg[0] > 1.2 * base.mean_deg[0]);
  // A 60th of the damping: oscillates about zero, mean of |sin| against its peak 0.64.
  CHECK(mean_over_max(run("per-frame")) > 1.5 * mean_over_max(base));
  // Delay takes the damping away.
  CHECK(run("older").step_limit < 0.6 * base.step_limit);
  CHECK_FALSE(run("older").stable);
  // Semi-implicit: a backward difference of the DVR is its velocity.
  CHECK(error_sum(run("true-velocities")) == doctest::Approx(error_sum(base)).epsilon(0.1));
  CHECK(run("ratio-0.2").spec.gains.k2 == doctest::Approx(0.2 * run("ratio-0.2").spec.gains.k1));
}
