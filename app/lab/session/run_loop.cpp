#include "app/lab/session/run_loop.h"

namespace twinarm {

constexpr auto kMaxBurst = std::chrono::microseconds(4000);  // before commands are read again
constexpr double kMaxCatchUp = 0.05;                         // delay that is made up for [s]

void RunLoop::begin(std::unique_ptr<LabRun> run, LabVariants variants) {
  run_ = std::move(run);
  variants_ = std::move(variants);
}

LabFrame RunLoop::frame() {
  LabFrame frame = run_->frame(names_);
  variants_.add_to(frame, names_);
  return frame;
}

bool RunLoop::take_steps(const std::function<void()>& after) {
  const Clock::time_point begin = Clock::now();
  const double due = has_single_steps() ? HUGE_VAL : pace_.due(begin);
  const double h = run_->prepared().run.step;
  while (run_->view().time() + 0.5 * h < due) {
    const double cpu = thread_cpu_time();
    if (!take_step()) return false;
    const double taken = thread_cpu_time() - cpu;
    cpu_ += taken;
    longest_cpu_ = std::max(longest_cpu_, taken);
    ++steps_;
    after();
    if (steps_left_ > 0 && --steps_left_ == 0) return true;
    if (Clock::now() - begin > kMaxBurst) break;
  }
  pace_.limit_backlog(Clock::now(), run_->view().time(), kMaxCatchUp);
  return true;
}

bool RunLoop::take_step() {
  std::optional<LabInput> known;
  if (repeats_) known = timeline_.known_input(run_->view().time());
  repeats_ = known.has_value();
  const bool goes_on = run_->step(known ? &*known : nullptr);
  timeline_.add(run_->input());  // also of the step at which the run stops: a branch repeats it
  if (goes_on) variants_.follow(*run_);
  return goes_on;
}

std::pair<double, double> RunLoop::take_cost() {
  const std::pair cost{steps_ > 0 ? cpu_ / static_cast<double>(steps_) : 0, longest_cpu_};
  cpu_ = longest_cpu_ = 0;
  steps_ = 0;
  return cost;
}

void Timeline::begin(std::shared_ptr<const BuildResult> scene, std::vector<std::size_t> driven) {
  const std::lock_guard lock(mutex_);
  scene_ = std::move(scene);
  driven_ = std::move(driven);
  history_.begin_segment(scene_->request.changes);
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

void Timeline::clear() {
  const std::lock_guard lock(mutex_);
  history_ = before_ = LabHistory(history_.max_bytes());
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

std::pair<Timeline::Frame, std::vector<LabInput>> Timeline::since(double t) const {
  const std::lock_guard lock(mutex_);
  Frame from = history_.frame(history_.at(t));
  std::vector<LabInput> inputs = history_.inputs_after(from->recorded.step);
  return {std::move(from), std::move(inputs)};
}

std::optional<LabInput> Timeline::known_input(double t) const {
  const std::lock_guard lock(mutex_);
  if (before_.empty() || before_.at(t) + 1 == before_.size()) return std::nullopt;
  const LabInput* input = before_.input_at(t);
  return input ? *input : LabInput{};
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

std::shared_ptr<const BuildResult> Timeline::scene() const {
  const std::lock_guard lock(mutex_);
  return scene_;
}

void Timeline::save(const std::filesystem::path& file) const {
  const auto [history, scene, names, driven] = [this] {
    const std::lock_guard lock(mutex_);
    return std::tuple(history_, scene_, names_, driven_);
  }();
  history.save(*scene->scene, names, driven, file);
}

}  // namespace twinarm
