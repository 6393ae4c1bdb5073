#include "app/lab/lab_session.h"

#include <pthread.h>

#include <algorithm>
#include <cmath>

#include "app/lab/knobs/remedies.h"
#include "app/live/servo_clock.h"
#include "solver/fault.h"

namespace twinarm {
namespace {

constexpr auto kTick = std::chrono::milliseconds(1);
constexpr double kLongestBurst = 0.004;  // of steps between two looks at commands [s]
constexpr double kForgiven = 0.05;       // what is further behind is not made up for [s]
constexpr double kStatusEvery = 0.25;    // [s]
constexpr std::size_t kMostNotes = 20, kMostCommands = 4096;

double seconds(std::chrono::steady_clock::duration time) {
  return std::chrono::duration<double>(time).count();
}

}  // namespace

LabSession::LabSession(Built scene, const std::vector<GalleryScene>& gallery) : gallery_(gallery) {
  adopt(std::move(scene));
  publish();  // from now on there is something to be seen
  workshop_ =
      std::make_unique<Workshop>(Workshop::Out{[this](Built built) {
                                                 {
                                                   const std::lock_guard lock(mutex_);
                                                   built_.push_back(std::move(built));
                                                 }
                                                 told_.notify_all();
                                               },
                                               [this](const Order& order, const std::string& why) {
                                                 note("error", why);
                                                 const std::lock_guard lock(mutex_);
                                                 has_failed_ =
                                                     has_failed_ || order.what != Order::What::open;
                                                 told_.notify_all();
                                               }});
  thread_ = std::thread([this] { work(); });
}

LabSession::~LabSession() {
  end();
}

void LabSession::end() {
  {
    const std::lock_guard lock(mutex_);
    if (stop_) return;
    stop_ = true;
  }
  told_.notify_all();
  thread_.join();
  // Pages may still drop files: taken away under the lock, and waited for without it.
  std::unique_ptr<Workshop> workshop;
  {
    const std::lock_guard lock(mutex_);
    workshop = std::move(workshop_);
  }
}

void LabSession::push(LabCommand command) {
  {
    const std::lock_guard lock(mutex_);
    if (commands_.size() < kMostCommands) commands_.push_back(std::move(command));
  }
  told_.notify_all();
}

void LabSession::note(const std::string& level, const std::string& text) {
  {
    const std::lock_guard lock(mutex_);
    if (new_notes_.size() < kMostNotes) new_notes_.push_back({0, level, text});
  }
  told_.notify_all();
}

void LabSession::open(Order order) {
  {
    const std::lock_guard lock(mutex_);
    if (workshop_) return workshop_->order(std::move(order));
  }
  if (order.done) order.done("the lab is ending");
}

LabNow LabSession::now() const {
  const std::lock_guard lock(mutex_);
  return now_;
}

void LabSession::wait(std::uint64_t seen, double longest) const {
  std::unique_lock lock(mutex_);
  const std::uint64_t woken = woken_;
  changed_.wait_for(lock, std::chrono::duration<double>(longest),
                    [&] { return now_.number != seen || woken_ != woken; });
}

void LabSession::wake() {
  {
    const std::lock_guard lock(mutex_);
    ++woken_;
  }
  changed_.notify_all();
}

void LabSession::set_rate(double frames_per_second) {
  const std::lock_guard lock(mutex_);
  frame_interval_ = 1 / frames_per_second;
}

// The run's thread.
void LabSession::work() {
  pthread_setname_np(pthread_self(), "lab run");
  next_tick_ = Clock::now();
  pace_.begin(next_tick_, run_->time(), status_.speed);
  for (;;) {
    take_commands();
    {
      const std::lock_guard lock(mutex_);
      if (stop_) return;
    }
    const Clock::time_point now = Clock::now();
    if (steps_left_ > 0)
      take_steps(now, HUGE_VAL);
    else if (status_.playing)
      take_steps(now, pace_.due(now));
    else
      pace_.begin(now, run_->time(), status_.speed);
    publish();
    rest();
  }
}

// Until the next step is due, or a command comes.
void LabSession::rest() {
  std::unique_lock lock(mutex_);
  const auto is_told = [this] {
    return stop_ || has_failed_ || !commands_.empty() || !built_.empty() || !new_notes_.empty();
  };
  if (steps_left_ > 0) return;
  if (status_.playing)
    told_.wait_until(lock, next_tick_, is_told);
  else
    told_.wait_for(lock, std::chrono::milliseconds(200), is_told);
  next_tick_ = std::max(next_tick_ + kTick, Clock::now());
}

// Up to the run time `due`, but no longer than a burst.
void LabSession::take_steps(Clock::time_point begin, double due) {
  const double h = run_->step_length();
  while (run_->time() + 0.5 * h < due) {
    const double cpu = thread_cpu_time();
    if (!take_step()) return die();
    const double taken = thread_cpu_time() - cpu;
    cpu_ += taken;
    longest_cpu_ = std::max(longest_cpu_, taken);
    ++steps_;
    is_stale_ = true;
    if (is_frame_due()) publish();
    if (steps_left_ > 0 && --steps_left_ == 0) return;
    if (seconds(Clock::now() - begin) > kLongestBurst) break;
  }
  pace_.forgive(Clock::now(), run_->time(), kForgiven);
}

// Frames stand at multiples of as many steps as fit between two of them: evenly, and in a branch at
// the same steps as before. Of a run that does not keep up, more often.
bool LabSession::is_frame_due() const {
  const double steps = status_.speed * frame_interval_ / run_->step_length();
  long apart = std::max(1L, static_cast<long>(steps));
  while (apart > 1 && status_.pace < 0.75 * static_cast<double>(apart) / steps) apart /= 2;
  return run_->step_count() % apart == 0;
}

// By the hand as it is now; in a branch, as long as it is known, by what the hand did then.
bool LabSession::take_step() {
  bool went_on = false;
  if (does_again_) {
    LabInput again;
    again.step = run_->step_count() + 1;
    const std::lock_guard lock(mutex_);
    if (const LabInput* known = before_.input(again.step)) again = *known;
    does_again_ = again.step < before_.newest()->recorded.step;
    went_on = run_->step(again);
  } else {
    went_on = run_->step();
  }
  if (!went_on) return false;
  const LabInput& input = run_->input();
  if (!input.hand && !input.pull) return true;
  const std::lock_guard lock(mutex_);
  history_.add(input);
  return true;
}

// The newest frame is remembered, and handed over with whatever else is new.
void LabSession::publish() {
  const Clock::time_point now = Clock::now();
  bool says_new = take_notes();
  if (seconds(now - last_told_) >= kStatusEvery && status_.playing) says_new = true;
  const bool is_due = is_stale_ && is_frame_due();
  const bool is_last = is_stale_ && (!status_.playing && steps_left_ == 0);
  if (!is_due && !is_last && !says_new && !is_news_) return;
  if (is_due || is_last) {
    remember();
    is_stale_ = false;
  }
  last_told_ = now;
  is_news_ = false;
  tell();
}

void LabSession::remember() {
  LabFrame frame = frame_of_run();
  if (!rows_ || rows_->size() != names_.rows.size())
    rows_ = std::make_shared<const std::vector<std::string>>(names_.rows);
  frame.pace = status_.pace = pace_.factor(Clock::now(), run_->time());
  frame.longest_step = longest_cpu_;
  frame.step_time = steps_ > 0 ? cpu_ / static_cast<double>(steps_) : 0;
  status_.step_time = frame.step_time;
  cpu_ = longest_cpu_ = 0;
  steps_ = 0;
  const std::lock_guard lock(mutex_);
  history_.add(std::move(frame));
}

// Names of new rows are looked at by whoever saves.
LabFrame LabSession::frame_of_run() {
  const std::lock_guard lock(mutex_);
  return run_->frame(names_);
}

void LabSession::tell() {
  static const char* const kSources[] = {"scene", "drag", "joints", "device"};
  static const char* const kMappings[] = {"paper", "arm", "cartesian"};
  status_.time = run_->time();
  status_.step = run_->step_length();
  status_.hand_source = run_->driven().empty() ? "" : kSources[static_cast<int>(hand_.source())];
  status_.hand_mapping = kMappings[static_cast<int>(hand_.mapping().kind)];
  status_.hand_felt = hand_.description();
  status_.hand_q = run_->driven_q();
  {
    const std::lock_guard lock(mutex_);
    LabNow now;
    now.number = now_.number + 1;
    now.scene = scene_;
    now.scene_number = status_.scene;
    now.change_number = change_number_;
    if (!history_.empty()) {
      status_.first = history_.frame(0)->recorded.t;
      status_.last = history_.newest()->recorded.t;
      now.frame = status_.at ? history_.frame(history_.at(*status_.at)) : history_.newest();
    }
    if (now.frame && !before_.empty() && now.frame->recorded.t <= before_.newest()->recorded.t)
      now.before = before_.frame(before_.at(now.frame->recorded.t));
    now.status = std::make_shared<const LabStatus>(status_);
    now.rows = rows_;
    now.input_came = input_came_;
    now_ = std::move(now);
  }
  changed_.notify_all();
}

bool LabSession::take_notes() {
  const std::lock_guard lock(mutex_);
  if (new_notes_.empty()) return false;
  for (LabNote& note : new_notes_) {
    note.number = ++notes_;
    status_.notes.push_back(std::move(note));
  }
  new_notes_.clear();
  if (status_.notes.size() > kMostNotes)
    status_.notes.erase(status_.notes.begin(),
                        status_.notes.end() - static_cast<std::ptrdiff_t>(kMostNotes));
  return true;
}

void LabSession::die() {
  status_.playing = false;
  steps_left_ = 0;
  is_stale_ = is_news_ = true;
  const PostMortem* found = run_->post_mortem();
  if (!found) return note("note", "the run has come to its end");
  LabEnd end;
  end.time = found->time;
  end.from = changed_at_;
  end.words = found->words;
  end.quantity = found->field;
  end.body = found->body;
  if (!found->suspects.empty()) end.spring = found->suspects.front().name;
  end.remedies = remedies_of(run_->prepared(), *found);
  status_.dead = std::move(end);
}

std::vector<std::shared_ptr<const LabFrame>> LabSession::history(double from) const {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<const LabFrame>> frames;
  if (history_.empty()) return frames;
  for (std::size_t n = history_.at(from); n < history_.size(); ++n)
    frames.push_back(history_.frame(n));
  return frames;
}

void LabSession::save(const std::filesystem::path& file) const {
  LabHistory history;
  std::shared_ptr<const Built> scene;
  LabNames names;
  std::vector<std::size_t> led;
  {
    const std::lock_guard lock(mutex_);
    history = history_;
    scene = scene_;
    names = names_;
    led = run_->led();
  }
  history.save(*scene->scene, names, led, file);
}

}  // namespace twinarm
