#include "app/lab/session/lab_session.h"

#include <pthread.h>

#include <algorithm>
#include <cmath>

#include "app/servo/servo_clock.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

constexpr auto kTick = std::chrono::milliseconds(1);
constexpr double kLongestBurst = 0.004;  // of steps between two looks at commands [s]
constexpr double kForgiven = 0.05;       // what is further behind is not made up for [s]
constexpr double kStatusEvery = 0.25;    // [s]
constexpr std::size_t kMostCommands = 4096;

double seconds(std::chrono::steady_clock::duration time) {
  return std::chrono::duration<double>(time).count();
}

}  // namespace

LabSession::LabSession(Built scene, const std::vector<GalleryScene>& gallery,
                       std::size_t most_bytes)
    : gallery_(gallery), history_(most_bytes), before_(most_bytes) {
  adopt(std::move(scene));
  publish();  // from now on there is something to be seen
  workshop_ = std::make_unique<Workshop>(
      Workshop::Out{[this](Built built) {
                      {
                        const std::lock_guard lock(mutex_);
                        built_.push_back(std::move(built));
                      }
                      told_.notify_all();
                    },
                    [this](const Order& order) {
                      const std::lock_guard lock(mutex_);
                      if (!order.asked.empty()) failed_ = order.asked.back().number;
                      told_.notify_all();
                    },
                    [this](const std::string& why) { note("error", why); }});
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

void LabSession::open(Order order) {
  std::optional<Order> left;
  const char* why = "something else was asked for before this was begun; try again";
  {
    const std::lock_guard lock(mutex_);
    order.is_shared = scene_->order.is_shared;
    if (workshop_) {
      left = workshop_->order(std::move(order));
    } else {
      left = std::move(order);
      why = "the lab is ending";
    }
  }
  if (left && left->done) left->done(why);  // it may ask the session something
}

LabNow LabSession::now() const {
  const std::lock_guard lock(mutex_);
  LabNow now = now_;
  now.wakes = wakes_;
  return now;
}

void LabSession::wait(const LabNow& seen, double longest) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(longest),
                    [&] { return now_.number != seen.number || wakes_ != seen.wakes; });
}

void LabSession::wake() {
  {
    const std::lock_guard lock(mutex_);
    ++wakes_;
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
    try {
      take_commands();
      {
        const std::lock_guard lock(mutex_);
        if (stop_) return;
      }
      advance();
    } catch (const std::exception& error) {
      show_failure(error.what());
    }
    rest();
  }
}

void LabSession::advance() {
  const Clock::time_point now = Clock::now();
  if (steps_left_ > 0)
    take_steps(now, HUGE_VAL);
  else if (status_.playing)
    take_steps(now, pace_.due(now));
  else
    pace_.begin(now, run_->time(), status_.speed);
  publish();
}

// The run pauses. A failure that comes again at once is shown once.
void LabSession::show_failure(const std::string& why) {
  status_.playing = false;
  steps_left_ = 0;
  is_news_ = true;
  const std::string text = "the run is paused: " + why;
  if (status_.notes.empty() || status_.notes.back().text != text) note("error", text);
}

// Until the next step is due, or a command comes.
void LabSession::rest() {
  std::unique_lock lock(mutex_);
  const auto is_told = [this] {
    return stop_ || failed_ || !commands_.empty() || !built_.empty() || !new_notes_.empty();
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
  lanes_.follow(*run_);
  for (const std::string& words : lanes_.take_words()) note("warning", words);
  const LabInput& input = run_->input();
  if (!input.hand && !input.pull) return true;
  const std::lock_guard lock(mutex_);
  history_.add(input);
  return true;
}

// The newest frame is remembered, and handed over with whatever else is new. The status goes with
// news at once; its times and measures alone, now and then.
void LabSession::publish() {
  const Clock::time_point now = Clock::now();
  const bool is_due = is_stale_ && is_frame_due();
  const bool is_last = is_stale_ && (!status_.playing && steps_left_ == 0);
  const bool has_notes = take_notes();
  const bool is_time = status_.playing && seconds(now - last_told_) >= kStatusEvery;
  const bool says_status = has_notes || is_time || is_news_ || is_last;
  if (!is_due && !says_status) return;
  if (is_due || is_last) {
    remember();
    is_stale_ = false;
  }
  if (says_status) last_told_ = now;
  is_news_ = false;
  tell(says_status);
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
  shown_input_came_ = input_came_;
  const std::lock_guard lock(mutex_);
  history_.add(std::move(frame));
}

// Names of new rows are looked at by whoever saves.
LabFrame LabSession::frame_of_run() {
  const std::lock_guard lock(mutex_);
  LabFrame frame = run_->frame(names_);
  lanes_.add_to(frame, names_);
  return frame;
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
