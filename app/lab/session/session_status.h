// What the session shows to other threads: the newest instant, its status and notes. They look at
// it or wait for it here.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "app/lab/run/history.h"
#include "app/lab/session/lab_status.h"
#include "app/lab/session/scene_builder_thread.h"
#include "app/lab/session/session_state.h"

namespace twinarm {

// What there is to be seen. Nothing in it changes any more.
struct LabNow {
  std::uint64_t number = 0;  // counts up with whatever changes here
  std::shared_ptr<const BuildResult> scene;
  long scene_number = 0, change_number = 0;
  std::shared_ptr<const LabFrame> frame;   // the newest, or the one that is looked back at
  std::shared_ptr<const LabFrame> before;  // at the same time, of the branch that was left
  std::shared_ptr<const LabStatus> status;
  std::shared_ptr<const std::vector<std::string>> rows;  // of the ledger, by their numbers
  std::chrono::steady_clock::time_point input_came{};    // the newest input in the frame
  std::uint64_t wakes = 0;                               // of wake() until it was looked at
};

class Publisher {
 public:
  // From any thread.
  LabNow now() const;
  // Until there is something newer than what was seen, or wake() was called since, or the time is
  // over.
  void wait(const LabNow& seen, double longest) const;
  void wake() const;
  // Numbered by it. Without a status: the one before holds.
  void publish(LabNow now);

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  LabNow now_;
  mutable std::uint64_t wakes_ = 0;
};

// Puts it together, by the run's thread.
class StatusReporter {
 public:
  StatusReporter(SessionState& state, Publisher& shown) : state_(state), shown_(shown) {}
  void set_rate(double frames_per_second) {
    frame_interval_ = 1 / frames_per_second;
  }  // any thread
  bool is_frame_due() const;
  void publish();  // what is new and due

 private:
  using Clock = std::chrono::steady_clock;

  void add_frame();
  bool take_notes();
  LabHandStatus status_of_hand() const;
  void show(bool with_status);

  SessionState& state_;
  Publisher& shown_;
  std::atomic<double> frame_interval_ = 1.0 / 60;  // [s]
  long notes_ = 0;
  Clock::time_point shown_input_came_{};  // the newest input in a frame
  Clock::time_point last_status_{};
  std::shared_ptr<const std::vector<std::string>> rows_;
};

}  // namespace twinarm
