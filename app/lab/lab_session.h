// The run of the lab: a thread that steps it in real time, does what it is told between two steps,
// and remembers.
//
// Real time: steps that are due are taken once a millisecond. Where they cost more than that, run
// time falls behind wall time, and `pace` says by how much; it is never made up for in a rush.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/lab/lab_command.h"
#include "app/lab/lab_status.h"
#include "app/lab/run/history.h"
#include "app/lab/run/lab_run.h"
#include "app/lab/workshop.h"

namespace twinarm {

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
};

class LabSession {
 public:
  explicit LabSession(Built scene);
  ~LabSession();

  // From any thread.
  void push(LabCommand command);
  void note(const std::string& level, const std::string& text);
  void open(Order order);
  LabNow now() const;
  // Until there is something newer than `seen`, or the time is over.
  void wait(std::uint64_t seen, double seconds) const;
  void wake() const { changed_.notify_all(); }
  std::vector<std::shared_ptr<const LabFrame>> history(double from) const;
  void set_rate(double frames_per_second);
  // The run as it is remembered, as the bytes of a recording. Throws InputError.
  std::string save() const;

 private:
  using Clock = std::chrono::steady_clock;

  void work();
  void take_commands();
  void act(const LabCommand& command);
  void act_on_time(const LabCommand& command);
  void act_on_hand(const LabCommand& command);
  void change(const std::vector<std::string>& texts);
  void branch(const LabCommand& command);
  void preset(const std::string& name);
  void order(Order::What what, double at);
  void adopt(Built built);
  void adopt_waiting();
  void take_steps(double due);
  void pause_or_sleep();
  void capture();
  void die();
  void publish();

  Workshop workshop_;
  mutable std::mutex mutex_;  // of what follows, up to the run's own
  mutable std::condition_variable changed_;
  std::condition_variable told_;
  std::deque<LabCommand> commands_;
  std::deque<Built> built_;
  std::vector<LabNote> new_notes_;
  std::optional<std::string> failed_;
  LabNow now_;
  History history_;
  double frame_interval_ = 1.0 / 60;
  bool stop_ = false;

  // Of the run's thread alone.
  std::shared_ptr<const Built> scene_;
  std::unique_ptr<LabRun> run_;
  LabStatus status_;
  std::vector<Change> wanted_;  // changes that stand, and those that are being built
  long steps_left_ = 0;         // of single steps
  std::vector<std::shared_ptr<const LabFrame>> before_;
  bool is_stale_ = true;  // something is to be published
  Clock::time_point origin_, last_frame_, newest_input_{};
  double run_origin_ = 0;

  std::thread thread_;
};

}  // namespace twinarm
