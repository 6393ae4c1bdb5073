// The run of the lab: a thread that steps it in real time, does what it is told between two steps,
// and remembers.
//
// Real time: steps that are due are taken once a millisecond. Where they cost more than that, run
// time falls behind wall time, and `pace` says by how much; it is never made up for in a rush.
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "app/lab/parameters/gallery.h"
#include "app/lab/session/scene_builder_thread.h"
#include "app/lab/session/session_commands.h"
#include "app/lab/session/session_status.h"

namespace twinarm {

class LabSession {
 public:
  // The gallery must outlive it. At most so much is remembered of a run [bytes].
  LabSession(BuildResult scene, const std::vector<GalleryScene>& gallery,
             std::size_t max_bytes = LabHistory::kMaxBytes);
  ~LabSession();
  void end();  // no thread of its own is left; now() stays as it was

  // From any thread.
  void push(LabCommand command) { state_.inbox.push(std::move(command)); }
  void note(const std::string& level, const std::string& text) { state_.inbox.note(level, text); }
  void open(BuildRequest order);
  const Publisher& shown() const { return shown_; }
  const Timeline& timeline() const { return state_.timeline; }
  void set_rate(double frames_per_second) { reporter_.set_rate(frames_per_second); }

 private:
  using Clock = std::chrono::steady_clock;

  void work();
  void take_inbox();
  void advance();
  void pause_for(const std::string& why);
  void show_end();
  void sleep();

  SessionState state_;
  SessionCommands commands_;
  Publisher shown_;
  StatusReporter reporter_;
  std::mutex builder_mutex_;
  std::unique_ptr<SceneBuilderThread> builder_;  // null: the session has ended
  Clock::time_point next_tick_{};                // of the run's thread alone
  std::thread thread_;
};

}  // namespace twinarm
