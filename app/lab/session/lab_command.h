// What a page says to the lab: one JSON object each (docs/reference/lab_protocol.md).
#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/lab/session/lab_status.h"
#include "app/lab/session/scene_builder_thread.h"
#include "solver/spatial/pose.h"

namespace twinarm {

struct LabCommand {
  enum class Do {
    // of each client by itself, whoever has the hand
    layers,
    glass,
    take,
    give,
    look,
    // of whoever has it
    play,
    step,
    speed,
    set,
    branch,
    preset,
    scene,
    reset,
    restore,
    hand,
    tip,
    joint,
    turn,
    axes,
    button,
    pull,
    drop
  };
  Do what = Do::drop;
  bool on = false;                 // play, glass, button (down)
  long count = 0;                  // step: steps; joint, button: index; pull, glass: body; give: to
  double value = 1;                // speed: factor; joint: value [rad, m]
  std::optional<double> at;        // look, branch [s]; look: none is the newest
  std::vector<std::string> names;  // layers; set, branch: changes
  std::string name;                // preset, scene; hand: source
  std::string spec;                // hand: of --device
  Vector3 point = Vector3::Zero();  // pull: of the body, link axes [m]; turn: yaw, pitch, roll
  Vector3 goal = Vector3::Zero();   // tip, pull: world [m]
  std::array<double, 6> rates{};    // axes
  double stamp = 0;                 // of the sender
  std::chrono::steady_clock::time_point came{};
};

// Throws InputError with all faults: no JSON, no such command, a key that is missing or of another
// kind, a number that is not finite.
LabCommand parse_command(const std::string& text);

// Whether only the holder of the hand may say it.
bool needs_hand(LabCommand::Do what);

// What other threads have for the run's thread, which takes it between two steps and sleeps here
// until something comes.
class Inbox {
 public:
  static constexpr std::size_t kMaxNotes = 20;

  // From any thread. What comes after the 4,096th command that waits is dropped; of notes, the
  // oldest.
  void push(LabCommand command);
  void push(BuildResult built);
  void push_refused(long number);  // what was asked for, up to this number
  void note(const std::string& level, const std::string& text);
  bool stop();  // false: it was stopped before

  // Of the run's thread.
  struct Contents {
    std::deque<LabCommand> commands;
    std::deque<BuildResult> built;
    std::optional<long> refused;
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
