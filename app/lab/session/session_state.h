// What the run's thread works on, for the parts of the session that do: commands, scenes, what is
// shown.
#pragma once

#include <chrono>
#include <deque>

#include "app/lab/run/lab_run.h"
#include "app/lab/session/lab_command.h"
#include "app/lab/session/run_loop.h"

namespace twinarm {

// Changes of the scene that were asked for, and are neither built nor refused yet.
class PendingChanges {
 public:
  void add(Asked asked) {
    asked.number = ++count_;
    pending_.push_back(std::move(asked));
  }
  void finish(long number) {
    while (!pending_.empty() && pending_.front().number <= number) pending_.pop_front();
  }
  void clear() { pending_.clear(); }
  std::vector<Asked> all() const { return {pending_.begin(), pending_.end()}; }

 private:
  std::deque<Asked> pending_;
  long count_ = 0;
};

struct SessionState {
  explicit SessionState(std::size_t max_bytes) : timeline(max_bytes), loop(timeline) {}
  Inbox inbox;        // any thread
  Timeline timeline;  // any thread
  LabHand hand;
  RunLoop loop;
  LabStatus status;
  PendingChanges pending;
  long change_number = 0;                              // counts up with each run
  double changed_at = 0;                               // time of the run [s]
  bool is_stale = true;                                // the newest frame is not the run's
  bool has_news = true;                                // something that no frame shows
  std::chrono::steady_clock::time_point input_came{};  // the newest
};

// Whether this is what the variants that run side by side differ by.
inline bool is_of_lanes(const LabStatus& status, const Change& change) {
  return !status.lanes.empty() && change.path == status.lanes.path;
}

}  // namespace twinarm
