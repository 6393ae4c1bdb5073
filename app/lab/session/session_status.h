// Publishes the newest frame, the status and notes of the session to other threads.
#pragma once

#include "app/lab/session/lab_command.h"
#include "app/lab/session/run_loop.h"

namespace twinarm {

// State of the run's thread, shared by the parts of the session.
struct SessionState {
  explicit SessionState(std::size_t max_bytes) : timeline(max_bytes), loop(timeline) {}
  Inbox inbox;        // thread-safe
  Timeline timeline;  // thread-safe
  OperatorInput hand;
  RunLoop loop;
  LabStatus status;
  std::vector<PendingChange> pending;                  // requested, neither built nor refused yet
  long pending_count = 0;                              // of all that were requested
  long change_number = 0;                              // counts runs
  double changed_at = 0;                               // run time [s]
  bool is_stale = true;                                // the run is beyond the newest frame
  bool has_news = true;                                // not visible in frames
  std::chrono::steady_clock::time_point input_came{};  // of the newest input

  void add(PendingChange change) {
    change.number = ++pending_count;
    pending.push_back(std::move(change));
  }
  void finish(long number) {  // the changes up to this one
    std::erase_if(pending, [=](const PendingChange& change) { return change.number <= number; });
  }
};

// Whether the variants differ by this parameter.
inline bool is_varied(const LabStatus& status, const Change& change) {
  return !status.variants.empty() && change.path == status.variants.path;
}

// Immutable once published.
struct LabNow : Timeline::View {
  std::uint64_t number = 0;  // counts publications
  long scene_number = 0, change_number = 0;
  std::shared_ptr<const LabStatus> status;
  std::shared_ptr<const std::vector<std::string>> rows;  // names of the energy balance
  std::chrono::steady_clock::time_point input_came{};    // of the newest input in the frame
  std::uint64_t wakes = 0;                               // calls of wake() so far
};

class Publisher {  // thread-safe
 public:
  LabNow now() const;
  // Until something newer than `seen` is published, wake() is called, or the time is over [s].
  void wait(const LabNow& seen, double timeout) const;
  void wake() const;
  // Numbers it. Without a status the one before is kept.
  void publish(LabNow now);

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  LabNow now_;
  mutable std::uint64_t wakes_ = 0;
};

// Used by the run's thread.
class StatusReporter {
 public:
  StatusReporter(SessionState& state, Publisher& shown) : state_(state), shown_(shown) {}
  void set_rate(double frames_per_second) {  // from any thread
    frame_interval_ = 1 / frames_per_second;
  }
  bool is_frame_due() const;
  void publish();  // what is new and due

 private:
  using Clock = std::chrono::steady_clock;

  void add_frame();
  bool take_notes();
  OperatorStatus operator_status() const;
  void show(bool with_status);

  SessionState& state_;
  Publisher& shown_;
  std::atomic<double> frame_interval_ = 1.0 / 60;  // [s]
  long notes_ = 0;
  Clock::time_point shown_input_came_{};  // of the newest input in a frame
  Clock::time_point last_status_{};
  std::shared_ptr<const std::vector<std::string>> rows_;
};

}  // namespace twinarm
