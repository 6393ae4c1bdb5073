// Suggested fixes, tried before they are offered.
#include <doctest/doctest.h>

#include "app/lab/run/remedy_trial.h"
#include "tests/app/lab/run/helpers.h"

namespace twinarm {
namespace {

const std::string kSpring = "coupling.one.";

// A run that its explicit spring has stopped, from a frame before the change of its stiffness.
RemedyTrial stopped_run() {
  Session s(arm_with("paper"));
  s.hand.choose(OperatorInput::Source::joints);
  s.hand.joint(0, 0.3);
  s.step(320);
  RemedyTrial trial;
  trial.changes = {{kSpring + "discretization", "explicit"}, {kSpring + "stiffness", "3e7"}};
  trial.from = s.history.newest();
  trial.names = s.names;
  trial.max_cpu = trial.max_cpu_of_all = 1e9;  // independent of the machine
  s.change(trial.changes);
  for (bool goes_on = true; goes_on;) {
    goes_on = s.run->step();
    s.history.add(s.run->input());
  }
  trial.inputs = s.history.inputs_after(trial.from->recorded.step);
  trial.stopped_at = s.run->view().time();
  trial.source = s.hand.source();
  trial.scene = std::make_shared<const LabScene>(std::move(s.scene));
  return trial;
}

bool never() {
  return false;
}

TEST_CASE("remedy trial: only fixes with which the run holds are returned") {
  const RemedyTrial trial = stopped_run();
  const SuggestedFix soft{"soft", {kSpring + "stiffness=2000"}};
  const SuggestedFix implicit{"implicit", {kSpring + "discretization=implicit"}};
  const SuggestedFix impossible{"impossible", {"coupling.none.stiffness=1"}};
  const auto found = fixes_that_hold(trial, {impossible, soft, implicit}, never);
  REQUIRE(found.size() == 2);
  CHECK(found[0].words == "soft");
  CHECK(found[1].words == "implicit");
}

TEST_CASE("remedy trial: a fix that does not hold is replaced by further ones, which hold") {
  const RemedyTrial trial = stopped_run();
  const auto found = fixes_that_hold(trial, {{"more", {kSpring + "stiffness=1e8"}}}, never);
  REQUIRE(!found.empty());
  for (const SuggestedFix& fix : found) {
    CAPTURE(fix.words);
    const auto again = fixes_that_hold(trial, {fix}, never);
    REQUIRE(!again.empty());
    CHECK(again.front().changes == fix.changes);
  }
}

TEST_CASE("remedy trial: ends at once when it is cancelled") {
  const RemedyTrial trial = stopped_run();
  int asked = 0;
  const auto cancel = [&] { return ++asked > 10; };
  CHECK(fixes_that_hold(trial, {{"soft", {kSpring + "stiffness=2000"}}}, cancel).empty());
  CHECK(asked < 20);
}

}  // namespace
}  // namespace twinarm
