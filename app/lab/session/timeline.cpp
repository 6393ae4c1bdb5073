#include "app/lab/session/timeline.h"

#include <utility>

namespace twinarm {

void Timeline::begin(std::shared_ptr<const Built> scene, std::vector<std::size_t> led) {
  const std::lock_guard lock(mutex_);
  scene_ = std::move(scene);
  led_ = std::move(led);
  history_.begin_segment(scene_->order.changes);
}

void Timeline::add(LabFrame frame, const LabNames& names) {
  const std::lock_guard lock(mutex_);
  if (names_.rows.size() != names.rows.size() ||
      names_.momentum_rows.size() != names.momentum_rows.size())
    names_ = names;
  history_.add(std::move(frame));
}

void Timeline::add(const LabInput& input) {
  const std::lock_guard lock(mutex_);
  history_.add(input);
}

void Timeline::forget() {
  const std::lock_guard lock(mutex_);
  history_ = before_ = LabHistory(history_.most_bytes());
  names_ = {};
}

Timeline::Frame Timeline::branch(double t) {
  const std::lock_guard lock(mutex_);
  if (history_.empty() || t < history_.frame(0)->recorded.t - 1e-9) return nullptr;
  const std::size_t n = history_.at(t);
  Frame from = history_.frame(n);
  before_ = history_.cut(n);
  return from;
}

Timeline::Known Timeline::known_input(long step) const {
  const std::lock_guard lock(mutex_);
  Known known;
  known.input.step = step;
  if (const LabInput* input = before_.input(step)) known.input = *input;
  known.goes_on = !before_.empty() && step < before_.newest()->recorded.step;
  return known;
}

Timeline::View Timeline::view(std::optional<double> t) const {
  const std::lock_guard lock(mutex_);
  View view;
  view.scene = scene_;
  if (history_.empty()) return view;
  view.first = history_.frame(0)->recorded.t;
  view.last = history_.newest()->recorded.t;
  view.frame = t ? history_.frame(history_.at(*t)) : history_.newest();
  const double shown = view.frame->recorded.t;
  if (!before_.empty() && shown <= before_.newest()->recorded.t)
    view.before = before_.frame(before_.at(shown));
  return view;
}

std::vector<Timeline::Frame> Timeline::frames(double from) const {
  const std::lock_guard lock(mutex_);
  std::vector<Frame> frames;
  if (history_.empty()) return frames;
  for (std::size_t n = history_.at(from); n < history_.size(); ++n)
    frames.push_back(history_.frame(n));
  return frames;
}

std::shared_ptr<const Built> Timeline::scene() const {
  const std::lock_guard lock(mutex_);
  return scene_;
}

void Timeline::save(const std::filesystem::path& file) const {
  LabHistory history;
  std::shared_ptr<const Built> scene;
  LabNames names;
  std::vector<std::size_t> led;
  {
    const std::lock_guard lock(mutex_);
    history = history_;
    scene = scene_;
    names = names_;
    led = led_;
  }
  history.save(*scene->scene, names, led, file);
}

}  // namespace twinarm
