#include "app/lab/session/lab_session.h"

#include <pthread.h>

#include <stop_token>

#include "app/lab/parameters/parameters.h"
#include "app/lab/run/remedy_trial.h"

namespace twinarm {
namespace {

constexpr auto kTick = std::chrono::milliseconds(1);
constexpr auto kIdle = std::chrono::milliseconds(200);

// The values that the scene's file gives to the parameters that were changed.
SuggestedFix values_of_file(const LabScene& scene, const std::vector<Change>& changes) {
  SuggestedFix fix{"values of the scene's file", {}};
  for (const LabParameter& parameter : parameters_of(scene.plan()->prepared))
    if (std::ranges::find(changes, parameter.path, &Change::path) != changes.end() &&
        !parameter.value().empty())
      fix.changes.push_back(parameter.path + "=" + parameter.value());
  return fix;
}

}  // namespace

LabSession::LabSession(BuildResult scene, const std::vector<GalleryScene>& gallery,
                       std::size_t max_bytes)
    : state_(max_bytes),
      commands_(state_, gallery, [this](BuildRequest request) { open(std::move(request)); }),
      reporter_(state_, shown_) {
  commands_.adopt(std::move(scene));
  reporter_.publish();
  builder_ = std::make_unique<SceneBuilderThread>(state_.inbox);
  thread_ = std::thread([this] { work(); });
}

void LabSession::end() {
  if (!state_.inbox.stop()) return;
  thread_.join();
  std::unique_ptr<SceneBuilderThread> builder;  // joined without the lock: open() may be called
  {
    const std::lock_guard lock(builder_mutex_);
    builder = std::move(builder_);
  }
}

void LabSession::open(BuildRequest request) {
  std::optional<BuildRequest> rejected;
  const char* why = "superseded by a newer request; try again";
  request.is_shared = state_.timeline.scene()->request.is_shared;
  {
    const std::lock_guard lock(builder_mutex_);
    if (builder_) {
      rejected = builder_->submit(std::move(request));
    } else {
      rejected = std::move(request);
      why = "the lab is ending";
    }
  }
  if (rejected && rejected->done) rejected->done(why);  // without the lock: may call the session
}

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
      show_failure(error.what());
    }
    if (state_.loop.has_single_steps()) continue;
    // Until the next step is due, or the inbox has something.
    state_.inbox.sleep_until(state_.status.playing ? next_tick_ : Clock::now() + kIdle);
    next_tick_ = std::max(next_tick_ + kTick, Clock::now());
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
  if (contents.tried) offer(std::move(*contents.tried));
  if (contents.refused) state_.finish(*contents.refused);
  for (BuildResult& one : contents.built) {
    const auto done = one.request.done;
    try {
      commands_.adopt(std::move(one));
      trial_.request_stop();
      reporter_.publish();  // so that the history begins at the start, not after some steps
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
      for (const std::string& text : state_.loop.take_warnings()) note("warning", text);
      if (reporter_.is_frame_due()) reporter_.publish();
    };
    if (!loop.take_steps(after)) show_end();
  } else {
    loop.set_pace(state_.status.speed);
  }
  reporter_.publish();
}

void LabSession::pause() {
  state_.status.playing = false;
  state_.loop.request_steps(0);
  state_.has_news = true;
}

// A failure that repeats at once is shown once.
void LabSession::show_failure(const std::string& why) {
  pause();
  const std::string text = "the run is paused: " + why;
  const std::vector<LabNote>& notes = state_.status.notes;
  if (notes.empty() || notes.back().text != text) note("error", text);
}

void LabSession::show_end() {
  pause();
  state_.is_stale = true;
  const PostMortem* found = state_.loop.run().post_mortem();
  if (!found) return note("note", "the run has ended");
  RunFailure end;
  end.time = found->time;
  end.words = found->words;
  std::vector<SuggestedFix> fixes = fixes_of(state_.loop.run().prepared(), *found);
  SuggestedFix before = values_of_file(*state_.timeline.scene()->scene, state_.status.changes);
  if (!before.changes.empty()) fixes.push_back(std::move(before));
  std::erase_if(fixes, [this](const SuggestedFix& fix) {
    return std::ranges::any_of(fix.changes, [this](const std::string& text) {
      return is_varied(state_.status, parse_change(text));
    });
  });
  end.from = try_fixes(std::move(fixes), end.time);
  state_.status.failure = std::move(end);
}

// From the last change or the start, at least a second and at most kMaxRewind before the stop.
// Returns that instant.
double LabSession::try_fixes(std::vector<SuggestedFix> fixes, double stopped_at) {
  constexpr double kMinRewind = 1, kMaxRewind = 5;  // [s]
  RemedyTrial trial;
  trial.scene = state_.timeline.scene()->scene;
  trial.changes = state_.status.changes;
  trial.stopped_at = stopped_at;
  trial.names = state_.loop.names();
  trial.source = state_.hand.source();
  std::tie(trial.from, trial.inputs) = state_.timeline.since(
      std::clamp(state_.changed_at, stopped_at - kMaxRewind, stopped_at - kMinRewind));
  const double from = trial.from->recorded.t;
  const auto work = [this, trial = std::move(trial), fixes = std::move(fixes),
                     run = state_.change_number](const std::stop_token& stop) {
    TriedFixes tried{run, {}};
    try {
      tried.fixes = fixes_that_hold(trial, fixes, [&] { return stop.stop_requested(); });
    } catch (const std::exception& error) {
      note("error", error.what());
    }
    if (!stop.stop_requested()) state_.inbox.push(std::move(tried));
  };
  trial_ = std::jthread(work);
  return from;
}

void LabSession::offer(TriedFixes tried) {
  if (tried.run != state_.change_number || !state_.status.failure) return;
  state_.status.failure->remedies = std::move(tried.fixes);
  state_.status.failure->trying = false;
  state_.has_news = true;
}

}  // namespace twinarm
