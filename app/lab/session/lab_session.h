// The lab's run in its own thread, in real time. Commands are executed between two steps.
//
// Once a millisecond the steps that are due are taken. If they take longer, run time falls behind
// wall time; the delay is not made up for. `pace` is the achieved share of the requested speed.
#pragma once

#include "app/lab/session/session_status.h"

namespace twinarm {

// Executes commands between two steps: at once, or by a request to the scene builder thread whose
// result is adopted later.

class SessionCommands {
 public:
  SessionCommands(SessionState& state, const std::vector<GalleryScene>& gallery,
                  std::function<void(BuildRequest)> open)
      : s_(state), gallery_(gallery), open_(std::move(open)) {}
  // Throws InputError; the command then has no effect.
  void act(const LabCommand& command);
  // Continues or begins the run with a built scene. Throws InputError.
  void adopt(BuildResult built);

 private:
  void act_on_input(const LabCommand& command);
  void switch_source(OperatorInput::Source source);
  void choose_source(const std::string& source, const std::string& spec);
  void change(const std::vector<std::string>& texts, std::optional<double> at);
  void open_preset(const std::string& name);
  void edit(const SceneEdit& edit);
  void request(BuildRequest::What what, double at = 0);
  BuildRequest request_of(BuildRequest::What what) const;
  Timeline::Frame start_of(const BuildRequest& request);

  SessionState& s_;
  const std::vector<GalleryScene>& gallery_;
  std::function<void(BuildRequest)> open_;
};

class LabSession {
 public:
  // The gallery must outlive it. `max_bytes`: of the history.
  LabSession(BuildResult scene, const std::vector<GalleryScene>& gallery,
             std::size_t max_bytes = LabHistory::kMaxBytes);
  ~LabSession() { end(); }
  void end();  // stops its threads; shown() keeps the last state

  // From any thread.
  void push(LabCommand command) { state_.inbox.push(std::move(command)); }
  void note(const std::string& level, const std::string& text) { state_.inbox.note(level, text); }
  void open(BuildRequest request);
  const Publisher& shown() const { return shown_; }
  const Timeline& timeline() const { return state_.timeline; }
  void set_rate(double frames_per_second) { reporter_.set_rate(frames_per_second); }

 private:
  using Clock = std::chrono::steady_clock;

  void work();
  void take_inbox();
  void advance();
  void pause();
  void show_failure(const std::string& why);
  void show_end();
  double try_fixes(std::vector<SuggestedFix> fixes, double stopped_at);
  void offer(TriedFixes tried);

  SessionState state_;
  SessionCommands commands_;
  Publisher shown_;
  StatusReporter reporter_;
  std::mutex builder_mutex_;
  std::unique_ptr<SceneBuilderThread> builder_;  // null: the session has ended
  Clock::time_point next_tick_{};                // used by the run's thread only
  std::thread thread_;
  std::jthread trial_;  // of fixes for the run that stopped
};

}  // namespace twinarm
