// The run of the lab: a thread that steps it in real time, does what it is told between two steps,
// and remembers.
//
// Real time: steps that are due are taken once a millisecond. Where they cost more than that, run
// time falls behind wall time, and `pace` says by how much; it is never made up for in a rush.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "app/lab/parameters/gallery.h"
#include "app/lab/run/history.h"
#include "app/lab/session/lab_status.h"
#include "app/lab/session/scene_builder_thread.h"
#include "app/lab/session/session_commands.h"
#include "app/lab/session/session_state.h"

namespace twinarm {

// What the session shows to other threads: the newest instant, its status and notes. They look at
// it or wait for it here.

// What there is to be seen. Nothing in it changes any more.
struct LabNow {
  std::uint64_t number = 0;  // counts up with whatever changes here
  std::shared_ptr<const Built> scene;
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
  void wake();
  // Numbered by it. Without a status: the one before holds.
  void publish(LabNow now);

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  LabNow now_;
  std::uint64_t wakes_ = 0;
};

class LabSession {
 public:
  // The gallery must outlive it. At most so much is remembered of a run [bytes].
  LabSession(Built scene, const std::vector<GalleryScene>& gallery,
             std::size_t most_bytes = LabHistory::kMostBytes);
  ~LabSession();
  void end();  // no thread of its own is left; now() stays as it was

  // From any thread.
  void push(LabCommand command) { state_.inbox.push(std::move(command)); }
  void note(const std::string& level, const std::string& text) { state_.inbox.note(level, text); }
  void open(Order order);
  const Publisher& shown() const { return shown_; }
  void wake() { shown_.wake(); }
  const Timeline& timeline() const { return state_.timeline; }
  void set_rate(double frames_per_second) { frame_interval_ = 1 / frames_per_second; }

 private:
  using Clock = std::chrono::steady_clock;

  void work();
  void take_inbox();
  void advance();
  void pause_for(const std::string& why);
  void show_end();
  void sleep();
  // What is shown: session_status.cpp.
  bool is_frame_due();
  void publish();
  void add_frame();
  bool take_notes();
  LabHandStatus status_of_hand();
  void show(bool with_status);

  SessionState state_;
  SessionCommands commands_;
  Publisher shown_;
  std::mutex builder_mutex_;
  std::unique_ptr<Workshop> builder_;              // null: the session has ended
  std::atomic<double> frame_interval_ = 1.0 / 60;  // [s]

  // Of the run's thread alone.
  long notes_ = 0;
  Clock::time_point shown_input_came_{};  // the newest input in a frame
  Clock::time_point last_status_{}, next_tick_{};
  std::shared_ptr<const std::vector<std::string>> rows_;

  std::thread thread_;
};

}  // namespace twinarm
