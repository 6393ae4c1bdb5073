// State of the run's thread, shared by the parts of the session.
#pragma once

#include <chrono>
#include <deque>

#include "app/lab/session/lab_command.h"
#include "app/lab/session/run_loop.h"

namespace twinarm {

// Requested changes that are neither built nor refused yet.
class PendingChanges {
 public:
  void add(PendingChange change) {
    change.number = ++count_;
    pending_.push_back(std::move(change));
  }
  void finish(long number) {
    while (!pending_.empty() && pending_.front().number <= number) pending_.pop_front();
  }
  void clear() { pending_.clear(); }
  std::vector<PendingChange> all() const { return {pending_.begin(), pending_.end()}; }

 private:
  std::deque<PendingChange> pending_;
  long count_ = 0;
};

struct SessionState {
  explicit SessionState(std::size_t max_bytes) : timeline(max_bytes), loop(timeline) {}
  Inbox inbox;        // thread-safe
  Timeline timeline;  // thread-safe
  OperatorInput hand;
  RunLoop loop;
  LabStatus status;
  PendingChanges pending;
  long change_number = 0;                              // counts runs
  double changed_at = 0;                               // run time [s]
  bool is_stale = true;                                // the run is beyond the newest frame
  bool has_news = true;                                // not visible in frames
  std::chrono::steady_clock::time_point input_came{};  // of the newest input
};

// Whether the variants differ by this parameter.
inline bool is_varied(const LabStatus& status, const Change& change) {
  return !status.variants.empty() && change.path == status.variants.path;
}

}  // namespace twinarm
