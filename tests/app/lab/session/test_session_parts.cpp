// Parts of the session without its thread.
#include <doctest/doctest.h>

#include "app/lab/session/session_status.h"
#include "tests/app/lab/run/helpers.h"
#include "tests/app/lab/session/built_scene.h"

namespace twinarm {
namespace {

LabFrame frame_at(long step) {
  LabFrame frame;
  frame.recorded.step = step;
  frame.recorded.t = 0.01 * static_cast<double>(step);
  return frame;
}

LabInput input_at(long step) {
  LabInput input;
  input.step = step;
  input.t = 0.01 * static_cast<double>(step - 1);
  input.h = 0.01;
  input.mouse = MouseSpringInput{};  // else it is not stored
  input.stamp = static_cast<double>(step);
  return input;
}

TEST_CASE("timeline: a branch knows the inputs after its start, until the last") {
  Timeline timeline(LabHistory::kMaxBytes);
  timeline.begin(std::make_shared<const BuildResult>(built_from(kSlowlyDriven)), {});
  for (long step = 1; step <= 5; ++step) {
    timeline.add(frame_at(step), {});
    timeline.add(input_at(step));
  }
  const Timeline::Frame from = timeline.branch(0.03);
  REQUIRE(from);
  CHECK(from->recorded.step == 3);
  CHECK(timeline.view({}).last == doctest::Approx(0.03));
  const auto stamp_at = [&](double t) { return timeline.known_input(t).value().stamp; };
  CHECK(stamp_at(0.03) == 4);
  CHECK(stamp_at(0.03 + 1e-12) == 4);  // rounding of summed steps
  CHECK(stamp_at(0.0375) == 4);        // the branch has shorter steps
  CHECK(stamp_at(0.04) == 5);
  CHECK_FALSE(timeline.known_input(0.05));
}

TEST_CASE("timeline: a time before the history begins no branch") {
  Timeline timeline(LabHistory::kMaxBytes);
  timeline.begin(std::make_shared<const BuildResult>(built_from(kSlowlyDriven)), {});
  CHECK(timeline.branch(0) == nullptr);
  timeline.add(frame_at(7), {});
  CHECK(timeline.branch(0.05) == nullptr);
  CHECK(timeline.branch(0.07) != nullptr);
}

TEST_CASE("inbox: keeps the first 4096 waiting commands") {
  Inbox inbox;
  for (long n = 0; n < 5000; ++n) {
    LabCommand command;
    command.count = n;
    inbox.push(command);
  }
  const Inbox::Contents contents = inbox.take();
  REQUIRE(contents.commands.size() == 4096);
  CHECK(contents.commands.back().count == 4095);
  CHECK(inbox.take().commands.empty());
}

TEST_CASE("inbox: a note is cut at 4000 bytes, between two characters") {
  Inbox inbox;
  std::string text = "a";
  while (text.size() < 70000) text += "\xc3\xa4";
  inbox.note("error", text);
  CHECK(inbox.take_notes().front().text == text.substr(0, 3999) + " ..");
  inbox.note("error", "short");
  CHECK(inbox.take_notes().front().text == "short");
}

TEST_CASE("pending changes: finished by a number not below theirs") {
  SessionState state(LabHistory::kMaxBytes);
  for (int n = 0; n < 3; ++n) state.add({});
  state.finish(2);
  REQUIRE(state.pending.size() == 1);
  CHECK(state.pending.front().number == 3);
}

}  // namespace
}  // namespace twinarm
