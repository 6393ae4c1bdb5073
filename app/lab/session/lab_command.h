// Commands of clients: one JSON object each (docs/reference/lab_protocol.md).
#pragma once

#include "app/lab/session/lab_status.h"
#include "app/lab/session/scene_builder_thread.h"

namespace twinarm {

struct LabCommand {
  std::string_view what = "release";  // its name
  bool on = false;                    // play, inspect, button (down)
  long count = 0;  // step: steps; joint, button: index; drag_body, inspect: body; grant_control: to
  double value = 1;                // speed: factor; joint: value [rad, m]
  std::optional<double> at;        // seek, branch [s]; seek: none is the newest
  std::vector<std::string> names;  // layers; set, branch: changes
  std::string name;                // preset, scene; edit: what; input: source
  std::string spec;                // edit: link or body; input: as of --device
  Vector3 point =
      Vector3::Zero();  // drag_body: on the body, link axes [m]; rotate_stylus: yaw, pitch, roll
  Vector3 goal = Vector3::Zero();  // drag_stylus, drag_body: world [m]
  std::array<double, 6> rates{};   // axes
  double stamp = 0;                // set by the client
  std::chrono::steady_clock::time_point came{};
};

// Throws InputError with all faults: not JSON, unknown command, missing key, wrong type or range.
LabCommand parse_command(const std::string& text);

// Whether only the client in control may send it.
bool needs_control(std::string_view what);
// Sent many times a second; visible in the next frame.
bool is_movement(std::string_view what);
// Of a valid command its name and what it has of the described keys: "play on = true"; of a
// movement its name alone.
std::string text_of_command(const std::string& text);

// Fixes that hold, for the run with this number.
struct TriedFixes {
  long run = 0;
  std::vector<SuggestedFix> fixes;
};

// Queue to the run's thread, which empties it between two steps and sleeps in it.
class Inbox {
 public:
  static constexpr std::size_t kMaxNotes = 20, kMaxNote = 4000;  // [bytes]

  // From any thread. Drops commands beyond 4,096 waiting ones, and the oldest of too many notes.
  void push(LabCommand command);
  void push(BuildResult built) {
    locked([&] { contents_.built.push_back(std::move(built)); });
  }
  // Pending changes up to this number are refused.
  void push_refused(long number) {
    locked([&] { contents_.refused = number; });
  }
  void push(TriedFixes tried) {
    locked([&] { contents_.tried = std::move(tried); });
  }
  void note(const std::string& level, const std::string& text);
  bool stop();  // false: already stopped

  // From the run's thread.
  struct Contents {
    std::deque<LabCommand> commands;
    std::deque<BuildResult> built;
    std::optional<long> refused;
    std::optional<TriedFixes> tried;
  };
  Contents take();
  std::deque<LabNote> take_notes();
  bool is_stopped() const;
  void sleep_until(std::chrono::steady_clock::time_point time);

 private:
  template <typename Put>
  void locked(Put put) {
    {
      const std::lock_guard lock(mutex_);
      put();
    }
    came_.notify_all();
  }

  mutable std::mutex mutex_;
  std::condition_variable came_;
  Contents contents_;
  std::deque<LabNote> notes_;
  bool stop_ = false;
};

}  // namespace twinarm
