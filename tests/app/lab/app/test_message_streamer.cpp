// A session in real time, and the messages sent to clients.
#include <algorithm>
#include <chrono>
#include <cstring>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "app/lab/app/clients.h"
#include "app/lab/app/message_streamer.h"
#include "tests/app/lab/run/helpers.h"
#include "tests/app/lab/session/built_scene.h"
#include "tests/support/waiting.h"

namespace twinarm {
namespace {

struct SentFrame {
  double time = 0, stamp = 0, age = 0;
  std::uint64_t step = 0;
  std::uint32_t flags = 0;
};

// A session, its streamer, and the messages sent.
struct Streamed {
  explicit Streamed(const std::string& text)
      : session(built_from(text), gallery),
        streamer(session, clients, gallery,
                 [this](ClientId client, MessageStreamer::Channel channel, Bytes bytes) {
                   if (client == 1)
                     take(channel, *bytes);
                   else
                     take_as_later_client(client, channel, *bytes);
                 }) {
    clients.opened(1);
    streamer.begin();
    REQUIRE(comes_true([&] { return !frames().empty(); }));
  }
  ~Streamed() {
    session.end();
    streamer.end();
  }

  void take(MessageStreamer::Channel channel, const std::string& bytes) {
    const std::lock_guard lock(mutex);
    if (channel == MessageStreamer::state_channel) ++states_;
    if (channel == MessageStreamer::frame_channel) frames_.push_back(read(bytes));
  }
  static SentFrame read(const std::string& bytes) {
    SentFrame frame;
    std::memcpy(&frame.time, bytes.data() + 8, 8);
    std::memcpy(&frame.stamp, bytes.data() + 16, 8);
    std::memcpy(&frame.age, bytes.data() + 24, 8);
    std::memcpy(&frame.step, bytes.data() + 32, 8);
    std::memcpy(&frame.flags, bytes.data() + 44, 4);
    return frame;
  }
  void take_as_later_client(ClientId client, MessageStreamer::Channel channel,
                            const std::string& bytes) {
    const std::lock_guard lock(mutex);
    later_messages_[client].push_back(
        {channel, channel == MessageStreamer::frame_channel ? read(bytes).step : 0});
  }
  // Of each later client: channels, with the step of frames.
  std::map<ClientId, std::vector<std::pair<MessageStreamer::Channel, std::uint64_t>>>
  later_messages() const {
    const std::lock_guard lock(mutex);
    return later_messages_;
  }
  std::vector<SentFrame> frames() const {
    const std::lock_guard lock(mutex);
    return frames_;
  }
  std::size_t states() const {
    const std::lock_guard lock(mutex);
    return states_;
  }
  LabStatus status() const { return *session.shown().now().status; }
  // Waits until all earlier commands are executed and streamed.
  void settle() {
    static int count = 0;
    const std::string text = "settled " + std::to_string(++count);
    session.note("note", text);
    REQUIRE(
        comes_true([&] { return !status().notes.empty() && status().notes.back().text == text; }));
    bool is_done = false;
    for (int n = 0; n < 2; ++n) {  // the first one may overtake the state
      is_done = false;
      streamer.post([&](MessageStreamer&) {
        const std::lock_guard lock(mutex);
        is_done = true;
      });
      REQUIRE(comes_true([&] {
        const std::lock_guard lock(mutex);
        return is_done;
      }));
    }
  }

  const std::vector<GalleryScene> gallery;
  mutable std::mutex mutex;
  std::vector<SentFrame> frames_;
  std::size_t states_ = 0;
  std::map<ClientId, std::vector<std::pair<MessageStreamer::Channel, std::uint64_t>>>
      later_messages_;
  Clients clients;
  LabSession session;
  MessageStreamer streamer;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

TEST_CASE("rate limiter: bounded rate, two at once after a pause, no catching up") {
  using std::chrono::microseconds;
  const RateLimiter::Time start = RateLimiter::Time{} + std::chrono::hours(1);
  const auto sent = [&](int every_us, int count) {
    RateLimiter limiter;
    int went = 0;
    for (int n = 0; n < count; ++n) {
      const RateLimiter::Time now = start + n * microseconds(every_us);
      if (limiter.wait(now) > 0) continue;
      limiter.take(now, 50);
      ++went;
    }
    return went;
  };
  CHECK(sent(25'000, 400) == 400);  // 40 a second: all
  CHECK(sent(20'000, 500) == 500);
  CHECK(sent(1'000, 10'000) == 501);  // 1000 a second, for 10 s
  RateLimiter limiter;
  limiter.take(start, 50);
  CHECK(limiter.wait(start) == 0);  // the second of two
  limiter.take(start, 50);
  CHECK(limiter.wait(start) == doctest::Approx(0.02));
  CHECK(limiter.wait(start + microseconds(15'000)) == doctest::Approx(0.005));
  const RateLimiter::Time later = start + std::chrono::seconds(9);
  limiter.take(later, 50);
  limiter.take(later, 50);
  CHECK(limiter.wait(later) == doctest::Approx(0.02));
}

TEST_CASE("lab frames: commands and notes repeat no frame; inputs are in the next frame") {
  Streamed lab(kSlowlyDriven);
  const auto start = std::chrono::steady_clock::now();
  const std::size_t states = lab.states();
  for (int n = 1; n <= 300; ++n) {
    lab.session.push(parse_command(R"({"do": "joint", "index": 0, "value": 0.1, "stamp": )" +
                                   std::to_string(n) + "}"));
    if (n % 3 == 0) lab.session.push(parse_command(R"({"do": "seek", "at": null})"));
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
  }
  const double gone = seconds_since(start);
  const std::size_t sent = lab.states() - states;
  REQUIRE(comes_true([&] { return lab.frames().back().stamp == 300; }));
  const std::vector<SentFrame> frames = lab.frames();
  CHECK(frames.size() > 5);
  for (std::size_t n = 1; n < frames.size(); ++n) {
    CHECK(frames[n].step > frames[n - 1].step);
    CHECK(frames[n].stamp >= frames[n - 1].stamp);
  }
  CHECK(static_cast<double>(frames.size()) <= 63.0 * seconds_since(start) + 5);
  // State messages for the 100 `look`s, not for movements; without news a few times a second.
  CHECK(sent > 0);
  CHECK(static_cast<double>(sent) <= 100 + 8 * gone + 5);
}

TEST_CASE("lab frames: while paused one for each visible change, and the last one of many steps") {
  Streamed lab(kSlowlyDriven);
  lab.session.push(parse_command(R"({"do": "play", "on": false})"));
  REQUIRE(comes_true([&] { return (lab.frames().back().flags & 1) != 0; }));
  lab.settle();
  const std::size_t before = lab.frames().size();
  for (int n = 0; n < 10; ++n) {  // at most twenty notes are kept
    lab.session.note("note", "something");
    lab.session.push(parse_command(R"({"do": "speed", "factor": 1})"));
  }
  lab.settle();
  CHECK(lab.frames().size() == before);
  // Another layer.
  lab.clients.want_layers(1, {"bodies", "frames"});
  lab.streamer.look_again();
  REQUIRE(comes_true([&] { return lab.frames().size() > before; }));
  lab.settle();
  CHECK(lab.frames().size() == before + 1);
  const std::uint64_t step = lab.frames().back().step;
  lab.session.push(parse_command(R"({"do": "step", "steps": 5000})"));
  REQUIRE(comes_true([&] { return lab.frames().back().step == step + 5000; }));
  lab.session.push(parse_command(R"({"do": "seek", "at": 0})"));
  REQUIRE(comes_true([&] { return (lab.frames().back().flags & 2) != 0; }));
  CHECK(lab.frames().back().step == 0);
}

TEST_CASE(
    "message streamer: pages hear each second that the lab is there, also while it is paused") {
  Streamed lab(kSlowlyDriven);
  lab.session.push(parse_command(R"({"do": "play", "on": false})"));
  lab.settle();
  const std::size_t before = lab.states();
  CHECK(comes_true([&] { return lab.states() > before + 2; }));
}

TEST_CASE("message streamer: a new client gets the scene first, and each frame once") {
  Streamed lab(kSlowlyDriven);
  for (ClientId client = 2; client < 60; ++client) {
    lab.clients.opened(client);
    if (client % 2 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(3));
    lab.streamer.look_again();
  }
  REQUIRE(comes_true([&] {
    const auto sent = lab.later_messages();
    return sent.size() == 58 &&
           std::ranges::all_of(sent, [](const auto& entry) { return entry.second.size() > 8; });
  }));
  for (const auto& [client, messages] : lab.later_messages()) {
    CHECK(messages.front().first == MessageStreamer::scene_channel);
    std::set<std::uint64_t> steps;
    for (const auto& [channel, step] : messages)
      if (channel == MessageStreamer::frame_channel) CHECK(steps.insert(step).second);
  }
}

TEST_CASE("message streamer: an exception while drawing is shown as an error, and frames go on") {
  Streamed lab(kSlowlyDriven);
  for (int n = 0; n < 2; ++n)
    lab.streamer.post([](MessageStreamer&) { throw std::runtime_error("no such mesh"); });
  REQUIRE(comes_true([&] { return !lab.status().notes.empty(); }));
  lab.settle();
  const std::vector<LabNote> notes = lab.status().notes;
  CHECK(notes.front().level == "error");
  CHECK(notes.front().text == "the lab cannot draw this: no such mesh");
  CHECK(notes.size() == 2);  // the other one is that of settle()
  const std::size_t before = lab.frames().size();
  CHECK(comes_true([&] { return lab.frames().size() > before + 5; }));
}

TEST_CASE("lab session: a wake-up between now() and wait() ends the wait") {
  const std::vector<GalleryScene> gallery;
  LabSession session(built_from(kFreeBox), gallery);
  session.push(parse_command(R"({"do": "play", "on": false})"));
  REQUIRE(comes_true([&] { return !session.shown().now().status->playing; }));
  const LabNow seen = session.shown().now();
  session.shown().wake();
  constexpr double kLongest = 20;
  const auto start = std::chrono::steady_clock::now();
  session.shown().wait(seen, kLongest);
  CHECK(seconds_since(start) < kLongest);
  // Without a wake-up it waits.
  const LabNow again = session.shown().now();
  CHECK(again.number == seen.number);
  const auto begin = std::chrono::steady_clock::now();
  session.shown().wait(again, 0.05);
  CHECK(seconds_since(begin) >= 0.05);
}

TEST_CASE("lab session: a client that connects later gets the present input source") {
  Streamed lab(kSlowlyDriven);
  CHECK(lab.status().hand.source == "scene");
  CHECK(lab.status().hand.mode.empty());
  CHECK_FALSE(lab.status().hand.gripper_closed);
  lab.session.push(parse_command(R"({"do": "input", "source": "drag"})"));
  lab.session.push(parse_command(R"({"do": "button", "index": 0, "down": true})"));
  REQUIRE(comes_true([&] { return lab.status().hand.gripper_closed; }));
  CHECK(lab.status().hand.source == "drag");
  CHECK(lab.status().hand.mode == "live");
  CHECK(lab.status().hand.spec.empty());
  // Releasing the mouse does not open the gripper.
  lab.session.push(parse_command(R"({"do": "release"})"));
  lab.settle();
  CHECK(lab.status().hand.gripper_closed);
  lab.session.push(
      parse_command(R"({"do": "input", "source": "device", "spec": "virtual:synthetic:4"})"));
  REQUIRE(comes_true([&] { return lab.status().hand.source == "device"; }));
  CHECK(lab.status().hand.spec == "virtual:synthetic:4");
  const std::string message = state_message(lab.status(), lab.clients.view(), {}, {});
  for (const char* part :
       {R"("spec": "virtual:synthetic:4")", R"("mode": "live")", R"("gripper": )"})
    CHECK(message.find(part) != std::string::npos);
}

}  // namespace twinarm
