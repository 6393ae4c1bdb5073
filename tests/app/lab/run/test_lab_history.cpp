// History of a run: branches and saved recordings.
#include "tests/app/lab/run/helpers.h"

namespace twinarm {

TEST_CASE("lab run: a branch with the same input repeats the frames' memory bit for bit") {
  Session s(arm_with("device"));
  s.hand.choose(OperatorInput::Source::drag);
  const Vector3 tip = s.run->prepared().input.couplings->kvr(0).start().k.position(
      s.run->input_override().tip()->first, s.run->input_override().tip()->second);
  for (int n = 0; n < 50; ++n) {
    s.hand.tip(tip + Vector3(-0.1 * std::sin(0.1 * n), 0.2 * std::sin(0.2 * n), 0));
    if (n == 20)
      REQUIRE(s.run->drag(s.run->input_override().driven().back(), Vector3::Zero(), tip));
    if (n == 35) s.run->release_mouse();
    s.step(20);
  }
  const std::size_t from = s.history.at(0.3);
  const LabHistory left = s.history.cut(from);
  CHECK(s.history.size() == from + 1);
  LabRun again(s.scene.plan(), s.hand, left.frame(0).get());
  CHECK(again.restart_reason().empty());
  std::size_t same = 0;
  for (std::size_t n = 1; n < left.size(); ++n) {
    while (again.view().step() < left.frame(n)->recorded.step) {
      const LabInput* input = left.input(again.view().step() + 1);
      const LabInput none;
      REQUIRE(again.step(input ? input : &none));
    }
    const LabFrame frame = again.frame(s.names);
    same += frame.recorded.memory == left.frame(n)->recorded.memory ? 1 : 0;
    CHECK(frame.recorded.works == left.frame(n)->recorded.works);
  }
  CHECK(left.size() > 30);
  CHECK(same == left.size() - 1);
  // Then live input continues without a jump.
  std::vector<double> before = kvr_of(again);
  for (int n = 0; n < 200; ++n) {
    REQUIRE(again.step());
    const std::vector<double> now = kvr_of(again);
    for (std::size_t j = 0; j < now.size(); ++j) CHECK(std::abs(now[j] - before[j]) < 0.021);
    before = now;
  }
}

TEST_CASE("lab history: a saved run replays bit for bit, with operator input and changes") {
  Session s(arm_with("device"));
  s.hand.choose(OperatorInput::Source::drag);
  const TemporaryFolder folder;
  const auto drag = [&](int moves) {
    for (int n = 0; n < moves; ++n) {
      s.hand.tip(Vector3(0.5, 0.2 * std::sin(0.3 * n), 0.4));
      s.step(20);
    }
  };
  const auto check = [&](double from, std::size_t frames) {
    const std::filesystem::path file = folder.path() / "lab.twinrec";
    s.history.save(s.scene, s.names, s.run->input_override().couplings(), file);
    const Recording recording(file);
    CHECK(recording.size() >= frames);
    CHECK(recording.frame(0).t == doctest::Approx(from).epsilon(1e-9));
    const Replay again = replay(recording, 0, {});
    CHECK(again.hash == again.hash_again);
    CHECK(again.compared == recording.size() - 1);
    CHECK(again.equal == again.compared);
    for (std::size_t n = 0; n < recording.size(); ++n)  // the operator's input is not in the file
      CHECK(recording.frame(n).memory.size() > 0);
  };
  drag(20);
  check(0, 20);
  s.change({{"coupling.stiffness", "700"}, {"gravity", "0,0,-1.6"}});
  drag(20);
  check(0.4, 20);
  // After a mouse spring, which no header describes.
  REQUIRE(s.run->drag(s.run->input_override().driven()[1], Vector3(0.35, 0, 0.1),
                      Vector3(0.2, 0.2, 0.2)));
  drag(5);
  s.run->release_mouse();
  drag(20);
  check(0.912, 20);
  s.change({{"coupling.stiffness", "700"}, {"step", "0.0004"}});
  drag(20);
  check(1.3, 20);
}

TEST_CASE("lab history: the header of a saved run has the couplings of its frames") {
  Session s(arm_with("device"));
  const std::size_t couplings = s.scene.header({}, {}).couplings.size();
  const std::vector<Change> changes{{"coupling.two.type", "god-object"}};
  s.change(changes);
  s.step(32);
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "lab.twinrec";
  s.history.save(s.scene, s.names, s.run->input_override().couplings(), file);
  const Recording recording(file);
  CHECK(recording.header().couplings.size() > couplings);
  for (std::size_t n = 0; n < recording.size(); ++n)
    CHECK(recording.frame(n).coupling_forces.size() == recording.header().couplings.size());
}

TEST_CASE(
    "lab run: another step length continues at the same state and time, and can be branched") {
  Session s(arm_with("paper"));
  s.step(500);
  const State<double> before = s.run->view().simulation().state();
  s.change({{"step", "0.0003"}});
  CHECK(s.run->restart_reason().empty());
  CHECK(s.run->view().simulation().state().q == before.q);
  s.step(100);
  CHECK(s.run->view().time() == doctest::Approx(0.53).epsilon(1e-12));
  CHECK(s.run->view().step() == 600);
  const LabFrame half = s.run->frame(s.names);
  s.step(100);
  LabRun again(s.scene.plan({{"step", "0.0003"}}), s.hand, &half);
  for (int n = 0; n < 100; ++n) REQUIRE(again.step());
  CHECK(again.view().memory() == s.run->view().memory());
  // Another contact model has another checkpoint layout: the state is continued.
  const State<double> then = s.run->view().simulation().state();
  s.change({{"contact", "compliant"}});
  CHECK(s.run->view().simulation().state().q == then.q);
  CHECK(s.run->view().simulation().state().qd == then.qd);
  CHECK(s.run->view().time() == doctest::Approx(0.56).epsilon(1e-12));
  s.step(50);
}

TEST_CASE("lab history: stays within its bytes, removes the oldest first, finds times") {
  Session s(arm_with("device"));
  s.history = LabHistory(400000);
  s.history.begin_segment({});
  s.hand.choose(OperatorInput::Source::drag);
  s.step(3000);
  CHECK(s.history.bytes() <= 400000 + sizeof(LabInput) * 16);
  CHECK(s.history.bytes() > 300000);
  CHECK(s.history.size() > 5);
  CHECK(s.history.frame(0)->recorded.t > 0.5);
  CHECK(s.history.newest()->recorded.step == 2992);
  for (std::size_t n = 0; n < s.history.size(); ++n)
    CHECK(s.history.at(s.history.frame(n)->recorded.t) == n);
  CHECK(s.history.at(0) == 0);
  CHECK(s.history.at(1e9) == s.history.size() - 1);
  CHECK(s.history.input(s.history.frame(0)->recorded.step + 1));
  CHECK(!s.history.input(5));
}

}  // namespace twinarm
