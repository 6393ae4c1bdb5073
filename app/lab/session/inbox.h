// What other threads have for the run's thread, which takes it between two steps and sleeps here
// until something comes.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

#include "app/lab/session/lab_command.h"
#include "app/lab/session/lab_status.h"
#include "app/lab/session/scene_builder_thread.h"

namespace twinarm {

class Inbox {
 public:
  static constexpr std::size_t kMaxNotes = 20;

  // From any thread. What comes after the 4,096th command that waits is dropped; of notes, the
  // oldest.
  void push(LabCommand command);
  void push(Built built);
  void push_refused(long number);  // what was asked for, up to this number
  void note(const std::string& level, const std::string& text);
  bool stop();  // false: it was stopped before

  // Of the run's thread.
  struct Contents {
    std::deque<LabCommand> commands;
    std::deque<Built> built;
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
