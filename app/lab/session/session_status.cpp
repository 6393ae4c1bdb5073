#include "app/lab/session/session_status.h"

namespace twinarm {

constexpr auto kStatusEvery = std::chrono::milliseconds(250);

// A frame each n steps, at multiples of n: evenly spaced, and in a branch at the same steps as
// before. n is smaller where the run does not keep up.
bool StatusReporter::is_frame_due() const {
  const LabStatus& status = state_.status;
  const double steps = status.speed * frame_interval_ / state_.loop.run().prepared().run.step;
  long apart = std::max(1L, static_cast<long>(steps));
  while (apart > 1 && status.pace < 0.75 * static_cast<double>(apart) / steps) apart /= 2;
  return state_.loop.run().view().step() % apart == 0;
}

// Stores the newest frame and publishes it with everything else that is new. The status is
// published with news at once; for its times and measurements alone every kStatusEvery.
void StatusReporter::publish() {
  const Clock::time_point now = Clock::now();
  const bool is_playing = state_.status.playing;
  const bool is_due = state_.is_stale && is_frame_due();
  const bool is_last = state_.is_stale && !is_playing && !state_.loop.has_single_steps();
  const bool has_notes = take_notes();
  const bool is_time = is_playing && now - last_status_ >= kStatusEvery;
  const bool with_status = has_notes || is_time || state_.has_news || is_last;
  if (!is_due && !with_status) return;
  if (is_due || is_last) {
    add_frame();
    state_.is_stale = false;
  }
  if (with_status) last_status_ = now;
  state_.has_news = false;
  show(with_status);
}

void StatusReporter::add_frame() {
  LabStatus& status = state_.status;
  LabFrame frame = state_.loop.frame();
  const LabNames& names = state_.loop.names();
  if (!rows_ || *rows_ != names.rows)
    rows_ = std::make_shared<const std::vector<std::string>>(names.rows);
  std::tie(status.step_time, frame.longest_step) = state_.loop.take_cost();
  frame.pace = status.pace = state_.loop.pace_factor();
  frame.step_time = status.step_time;
  shown_input_came_ = state_.input_came;
  state_.timeline.add(std::move(frame), names);
}

bool StatusReporter::take_notes() {
  std::deque<LabNote> came = state_.inbox.take_notes();
  std::vector<LabNote>& notes = state_.status.notes;
  for (LabNote& note : came) {
    note.number = ++notes_;
    notes.push_back(std::move(note));
  }
  if (notes.size() > Inbox::kMaxNotes)
    notes.erase(notes.begin(), notes.end() - static_cast<std::ptrdiff_t>(Inbox::kMaxNotes));
  return !came.empty();
}

OperatorStatus StatusReporter::operator_status() const {
  using Source = OperatorInput::Source;
  static const char* const kModes[] = {"live", "held", "released"};
  const OperatorInput& hand = state_.hand;
  const InputOverride& driven = state_.loop.run().input_override();
  OperatorStatus shown;
  const Source source = hand.source();
  if (!driven.driven().empty())
    shown.source = OperatorInput::kSourceNames[static_cast<std::size_t>(source)];
  shown.spec = hand.spec();
  shown.mapping = kMappingNames[static_cast<std::size_t>(hand.mapping().kind)];
  shown.device = hand.description();
  shown.q = driven.q();
  const std::optional<OperatorFrame> now = driven.frame(state_.loop.run().view().time());
  if (now && hand.device()) shown.mode = kModes[now->mode];
  const bool is_users = source == Source::drag || source == Source::joints;
  shown.gripper_closed = is_users ? hand.gripper_closed() : now && now->gripper_closed;
  return shown;
}

void StatusReporter::show(bool with_status) {
  LabStatus& status = state_.status;
  status.time = state_.loop.run().view().time();
  status.step = state_.loop.run().prepared().run.step;
  if (with_status) status.hand = operator_status();
  LabNow now;
  static_cast<Timeline::View&>(now) = state_.timeline.view(status.at);
  status.first = now.first;
  status.last = now.last;
  status.variant_ends.clear();
  if (now.frame)
    for (const VariantFrame& variant : now.frame->variants)
      status.variant_ends.push_back(variant.stopped ? std::optional(variant.frame->recorded.t)
                                                    : std::nullopt);
  now.scene_number = status.scene;
  now.change_number = state_.change_number;
  if (with_status) now.status = std::make_shared<const LabStatus>(status);
  now.rows = rows_;
  now.input_came = shown_input_came_;
  shown_.publish(std::move(now));
}

LabNow Publisher::now() const {
  const std::lock_guard lock(mutex_);
  LabNow now = now_;
  now.wakes = wakes_;
  return now;
}

void Publisher::wait(const LabNow& seen, double timeout) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(timeout),
                    [&] { return now_.number != seen.number || wakes_ != seen.wakes; });
}

void Publisher::wake() const {
  {
    const std::lock_guard lock(mutex_);
    ++wakes_;
  }
  changed_.notify_all();
}

void Publisher::publish(LabNow now) {
  {
    const std::lock_guard lock(mutex_);
    now.number = now_.number + 1;
    if (!now.status) now.status = now_.status;
    now_ = std::move(now);
  }
  changed_.notify_all();
}

}  // namespace twinarm
