// Each remedy in a run of the scene that had stopped.
#include <doctest/doctest.h>

#include <algorithm>
#include <tuple>

#include "app/diagnose/post_mortem.h"
#include "tests/app/lab/parameters/parameter_scenes.h"

using namespace twinarm;

namespace {

// Bound of the kinetic energy: a diverging run with a point spring need not overflow.
constexpr double kEnergyBound = 1e4;  // [J]

struct BadScene {
  const char* name;
  std::string file;
  std::vector<std::string> changes;
};

std::vector<BadScene> bad_scenes() {
  const auto folder = read_gallery().front().file.parent_path();
  const auto scene = [&](const char* name) { return (folder / name).string(); };
  const std::string held =
      held_arm("", "type = \"linear\"\nstiffness = 1e5\ndamping = 100\nrate = 100\n");
  return {{"stiff", scene("tracking_map.toml"), {"coupling.stiffness=1e7"}},
          {"damped too much", scene("tracking_map.toml"), {"coupling.damping=20000"}},
          {"euler", scene("tracking_map.toml"), {"integrator=euler", "coupling.stiffness=2e6"}},
          {"long step", scene("tracking_map.toml"), {"step=0.02"}},
          {"as printed", scene("study_e4.toml"), {"coupling[1].stiffness=500000"}},
          {"as printed, turning", scene("study_e3.toml"), {"coupling[0].stiffness=200000"}},
          {"study",
           scene("study.toml"),
           {"coupling[0].discretization=explicit", "coupling[0].stiffness=1e8",
            "coupling[0].target=paper", "robot.q.joint1=1.5707963267948966",
            "robot.q.joint2=-0.7853981633974483", "coupling[1].target=paper"}},
          {"held", temporary_scene("held", held).string(), {}}};
}

}  // namespace

TEST_CASE("remedies: each offered one is stable for two seconds where the run had stopped") {
  for (const BadScene& bad : bad_scenes()) {
    INFO(std::string(bad.name));
    SimulatePlan plan = planned(bad.file, bad.changes, 2000);
    plan.run.energy_bound = kEnergyBound;
    const SimulateResult failure = run_plan(plan.input, plan.run, {});
    CHECK(failure.post_mortem);
    if (!failure.post_mortem) continue;
    const std::vector<SuggestedFix> remedies = fixes_of(plan, *failure.post_mortem);
    CHECK(!remedies.empty());
    for (const SuggestedFix& fix : remedies) {
      INFO(fix.words);
      CHECK(!fix.words.empty());
      std::vector<std::string> changes = bad.changes;
      for (const std::string& change : fix.changes) {
        INFO(change);
        changes.push_back(change);
      }
      SimulatePlan again = planned(bad.file, changes);
      again.run.duration = 2;
      again.run.energy_bound = kEnergyBound;
      const SimulateResult result = run_plan(again.input, again.run, {});
      CHECK(!result.post_mortem);
      CHECK(result.end == doctest::Approx(2));
    }
  }
}

TEST_CASE("remedies: step, gain and discretization are offered for too stiff a spring") {
  const BadScene bad = bad_scenes().front();
  const SimulatePlan plan = planned(bad.file, bad.changes, 2000);
  std::vector<std::string> first;
  for (const SuggestedFix& fix : fixes_of(plan, PostMortem())) first.push_back(fix.changes[0]);
  REQUIRE(first.size() == 3);
  CHECK(first[0].find("step=") == 0);
  CHECK(first[1].find("].stiffness=") != std::string::npos);
  CHECK(first[2].find("].discretization=implicit") != std::string::npos);
}

TEST_CASE("remedies: depend on kind and index of a violation, not on its name") {
  const BadScene stiff = bad_scenes().front();
  const SimulatePlan coupled = planned(stiff.file, stiff.changes);
  SimulatePlan damped = planned(stiff.file, {"integrator=euler", "coupling.stiffness=1"});
  damped.input.robot.model.damping.assign(damped.input.robot.model.nv, 1e4);
  const auto changes_by = [](const SimulatePlan& plan,
                             const std::vector<StabilityViolation>& violations) {
    PostMortem failure;
    failure.violations = violations;
    std::vector<std::string> changes;
    for (const SuggestedFix& fix : fixes_of(plan, failure))
      changes.insert(changes.end(), fix.changes.begin(), fix.changes.end());
    return changes;
  };
  for (const auto& [plan, kind, change] :
       {std::tuple<const SimulatePlan*, StabilityViolation::Kind, std::string>{
            &coupled, StabilityViolation::Kind::coupling, "coupling[1].discretization=implicit"},
        {&damped, StabilityViolation::Kind::joint_damper, "integrator=semi-implicit"}}) {
    std::vector<StabilityViolation> violations = find_violations(*plan);
    REQUIRE(!violations.empty());
    CHECK(violations.front().kind == kind);
    for (StabilityViolation& violation : violations) violation.name = "another name";
    const std::vector<std::string> changes = changes_by(*plan, violations);
    std::string offered;
    for (const std::string& c : changes) offered += c + " ";
    CAPTURE(offered);
    CHECK(std::find(changes.begin(), changes.end(), change) != changes.end());
  }
}

TEST_CASE("remedies: without a violated limit only a shorter step is offered") {
  const auto folder = read_gallery().front().file.parent_path();
  const SimulatePlan plan = planned(folder / "tracking_map.toml", {});
  for (const SuggestedFix& fix : fixes_of(plan, PostMortem())) {
    REQUIRE(fix.changes.size() == 1);
    CHECK(fix.changes[0].starts_with("step="));
  }
}
