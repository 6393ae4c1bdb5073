// What the session tells of itself: the newest instant, its status, notes, why it ended.
#include <algorithm>

#include "app/diagnose/remedies.h"
#include "app/lab/session/lab_session.h"

namespace twinarm {
namespace {

constexpr std::size_t kMostNotes = 20;

}  // namespace

void LabSession::note(const std::string& level, const std::string& text) {
  {
    const std::lock_guard lock(mutex_);
    if (new_notes_.size() == kMostNotes) new_notes_.pop_front();  // the last are told, as of all
    new_notes_.push_back({0, level, text});
  }
  told_.notify_all();
}

// The hand as it is told to pages: one that is opened later finds it so.
LabHandStatus LabSession::status_of_hand() const {
  using Source = LabHand::Source;
  static const char* const kSources[] = {"scene", "drag", "joints", "device"};
  static const char* const kMappings[] = {"paper", "arm", "cartesian"};
  static const char* const kModes[] = {"live", "held", "released"};
  LabHandStatus told;
  const Source source = hand_.source();
  if (!run_->driven().empty()) told.source = kSources[static_cast<int>(source)];
  told.spec = hand_.spec();
  told.mapping = kMappings[static_cast<int>(hand_.mapping().kind)];
  told.felt = hand_.description();
  told.q = run_->driven_q();
  const std::optional<LabHandFrame> now = run_->hand_frame();
  if (now && hand_.device()) told.mode = kModes[now->mode];
  const bool is_users = source == Source::drag || source == Source::joints;
  told.gripper_closed = is_users ? hand_.gripper_closed() : now && now->gripper_closed;
  return told;
}

void LabSession::tell(bool says_status) {
  status_.time = run_->time();
  status_.step = run_->step_length();
  if (says_status) status_.hand = status_of_hand();
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
    status_.lane_ends.clear();
    if (now.frame)
      for (const LaneFrame& lane : now.frame->lanes)
        status_.lane_ends.push_back(lane.stopped ? std::optional(lane.frame->recorded.t)
                                                 : std::nullopt);
    if (now.frame && !before_.empty() && now.frame->recorded.t <= before_.newest()->recorded.t)
      now.before = before_.frame(before_.at(now.frame->recorded.t));
    now.status = says_status ? std::make_shared<const LabStatus>(status_) : now_.status;
    now.rows = rows_;
    now.input_came = shown_input_came_;
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
  std::erase_if(end.remedies, [this](const Remedy& remedy) {
    return std::any_of(remedy.changes.begin(), remedy.changes.end(),
                       [this](const std::string& text) { return is_of_lanes(parse_change(text)); });
  });
  status_.dead = std::move(end);
}

}  // namespace twinarm
