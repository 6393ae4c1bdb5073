#include "app/lab/session/lab_session.h"

#include <pthread.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "app/diagnose/post_mortem.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

constexpr auto kTick = std::chrono::milliseconds(1);
constexpr auto kIdle = std::chrono::milliseconds(200);

}  // namespace

LabSession::LabSession(BuildResult scene, const std::vector<GalleryScene>& gallery,
                       std::size_t max_bytes)
    : state_(max_bytes),
      commands_(state_, gallery, [this](BuildRequest order) { open(std::move(order)); }),
      reporter_(state_, shown_) {
  commands_.adopt(std::move(scene));
  reporter_.publish();  // from now on there is something to be seen
  builder_ = std::make_unique<SceneBuilderThread>(state_.inbox);
  thread_ = std::thread([this] { work(); });
}

LabSession::~LabSession() {
  end();
}

void LabSession::end() {
  if (!state_.inbox.stop()) return;
  thread_.join();
  // Pages may still drop files: taken away under the lock, and waited for without it.
  std::unique_ptr<SceneBuilderThread> builder;
  {
    const std::lock_guard lock(builder_mutex_);
    builder = std::move(builder_);
  }
}

void LabSession::open(BuildRequest order) {
  std::optional<BuildRequest> left;
  const char* why = "something else was asked for before this was begun; try again";
  order.is_shared = state_.timeline.scene()->order.is_shared;
  {
    const std::lock_guard lock(builder_mutex_);
    if (builder_) {
      left = builder_->order(std::move(order));
    } else {
      left = std::move(order);
      why = "the lab is ending";
    }
  }
  if (left && left->done) left->done(why);  // it may ask the session something
}

// The run's thread.
void LabSession::work() {
  pthread_setname_np(pthread_self(), "lab run");
  next_tick_ = Clock::now();
  state_.loop.set_pace(state_.status.speed);
  for (;;) {
    try {
      take_inbox();
      if (state_.inbox.is_stopped()) return;
      advance();
    } catch (const std::exception& error) {
      pause_for(error.what());
    }
    sleep();
  }
}

void LabSession::take_inbox() {
  Inbox::Contents contents = state_.inbox.take();
  for (const LabCommand& command : contents.commands) try {
      commands_.act(command);
    } catch (const InputError& error) {
      for (const Diagnostic& fault : error.faults()) note("error", to_string(fault));
    } catch (const std::exception& error) {
      note("error", error.what());
    }
  if (contents.refused) state_.pending.finish(*contents.refused);
  for (BuildResult& one : contents.built) {
    const auto done = one.order.done;
    try {
      commands_.adopt(std::move(one));
      reporter_.publish();  // its start is seen and remembered, however soon steps follow
      if (done) done("");
    } catch (const std::exception& error) {
      note("error", error.what());
      if (done) done(error.what());
    }
  }
}

void LabSession::advance() {
  RunLoop& loop = state_.loop;
  if (loop.has_single_steps() || state_.status.playing) {
    const auto after = [this] {
      state_.is_stale = true;
      for (const std::string& words : state_.loop.take_warnings()) note("warning", words);
      if (reporter_.is_frame_due()) reporter_.publish();
    };
    if (!loop.take_steps(after)) show_end();
  } else {
    loop.set_pace(state_.status.speed);
  }
  reporter_.publish();
}

// The run pauses. A failure that comes again at once is shown once.
void LabSession::pause_for(const std::string& why) {
  state_.status.playing = false;
  state_.loop.step_once(0);
  state_.has_news = true;
  const std::string text = "the run is paused: " + why;
  const std::vector<LabNote>& notes = state_.status.notes;
  if (notes.empty() || notes.back().text != text) note("error", text);
}

void LabSession::show_end() {
  state_.status.playing = false;
  state_.loop.step_once(0);
  state_.is_stale = state_.has_news = true;
  const PostMortem* found = state_.loop.run().post_mortem();
  if (!found) return note("note", "the run has come to its end");
  LabEnd end;
  end.time = found->time;
  end.from = state_.changed_at;
  end.words = found->words;
  end.quantity = found->field;
  end.body = found->body;
  if (!found->suspects.empty()) end.spring = found->suspects.front().name;
  end.remedies = remedies_of(state_.loop.run().prepared(), *found);
  std::erase_if(end.remedies, [this](const SuggestedFix& fix) {
    return std::ranges::any_of(fix.changes, [this](const std::string& text) {
      return is_of_lanes(state_.status, parse_change(text));
    });
  });
  state_.status.dead = std::move(end);
}

// Until the next step is due, or a command comes.
void LabSession::sleep() {
  if (state_.loop.has_single_steps()) return;
  state_.inbox.sleep_until(state_.status.playing ? next_tick_ : Clock::now() + kIdle);
  next_tick_ = std::max(next_tick_ + kTick, Clock::now());
}

}  // namespace twinarm
