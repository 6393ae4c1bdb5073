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
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/lab/parameters/gallery.h"
#include "app/lab/run/history.h"
#include "app/lab/run/lab_run.h"
#include "app/lab/run/variants.h"
#include "app/lab/session/lab_command.h"
#include "app/lab/session/lab_status.h"
#include "app/lab/session/pace.h"
#include "app/lab/session/scene_builder_thread.h"

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
  std::uint64_t wakes = 0;  // of LabSession::wake() until it was looked at
};

class LabSession {
 public:
  // The gallery must outlive it. At most so much is remembered of a run [bytes].
  LabSession(Built scene, const std::vector<GalleryScene>& gallery,
             std::size_t most_bytes = LabHistory::kMostBytes);
  ~LabSession();
  void end();  // no thread of its own is left; now() stays as it was

  // From any thread.
  void push(LabCommand command);
  void note(const std::string& level, const std::string& text);
  void open(Order order);
  LabNow now() const;
  // Until there is something newer than what was seen, or wake() was called since, or the time is
  // over.
  void wait(const LabNow& seen, double longest) const;
  void wake();
  std::vector<std::shared_ptr<const LabFrame>> history(double from) const;
  void set_rate(double frames_per_second);
  // The run as it is remembered, as a recording. Throws InputError.
  void save(const std::filesystem::path& file) const;

 private:
  using Clock = std::chrono::steady_clock;

  // The loop: lab_session.cpp.
  void work();
  void advance();
  void show_failure(const std::string& why);
  void rest();
  void take_steps(Clock::time_point begin, double due);
  bool take_step();
  bool is_frame_due() const;
  void publish();
  void remember();
  LabFrame frame_of_run();
  bool is_of_lanes(const Change& change) const;
  // What it tells: session_status.cpp.
  LabHandStatus status_of_hand() const;
  void tell(bool says_status);
  bool take_notes();
  void die();
  // What it is told: session_commands.cpp.
  void take_commands();
  void act(const LabCommand& command);
  void act_on_hand(const LabCommand& command);
  void lead_by(LabHand::Source source);
  void choose_hand(const std::string& source, const std::string& spec);
  void change(const std::vector<std::string>& texts, std::optional<double> at);
  void preset(const std::string& name);
  void open_from_gallery(const std::string& name);
  void ask(Asked asked);
  void order(Order::What what, double at);
  void done_with(long number);
  void adopt(Built built);
  LabHistory::Frame start_of(const Order& order);
  void forget();

  const std::vector<GalleryScene>& gallery_;
  std::unique_ptr<Workshop> workshop_;

  mutable std::mutex mutex_;  // of what follows, up to the run's own
  mutable std::condition_variable changed_, told_;
  std::deque<LabCommand> commands_;
  std::deque<Built> built_;
  std::deque<LabNote> new_notes_;
  std::optional<long> failed_;  // what was asked for up to this number
  LabNow now_;
  LabHistory history_, before_;  // before_: of the branch that was left, from where it was left
  std::uint64_t wakes_ = 0;
  bool stop_ = false;

  std::atomic<double> frame_interval_ = 1.0 / 60;  // [s]

  // Of the run's thread alone.
  std::shared_ptr<const Built> scene_;
  LabHand hand_;
  std::unique_ptr<LabRun> run_;
  LabLanes lanes_;
  LabNames names_;
  LabStatus status_;
  std::deque<Asked> asked_;  // and not yet built or refused
  long asked_count_ = 0;
  long change_number_ = 0, notes_ = 0;
  double changed_at_ = 0;             // time of the run [s]
  long steps_left_ = 0;               // of single steps
  bool does_again_ = false;           // what came in the steps of before_ comes again
  bool is_stale_ = true;              // the newest frame is not the run's
  bool is_news_ = true;               // something else is to be told
  double cpu_ = 0, longest_cpu_ = 0;  // since the frame before [s]
  long steps_ = 0;                    // likewise
  Pace pace_;
  Clock::time_point input_came_{}, shown_input_came_{};  // the newest; the newest in a frame
  Clock::time_point last_told_{}, next_tick_{};          // last_told_: the status
  std::shared_ptr<const std::vector<std::string>> rows_;

  std::thread thread_;
};

}  // namespace twinarm
