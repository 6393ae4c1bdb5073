#include "app/lab/run/history.h"

namespace twinarm {
namespace {

template <class T>
std::size_t bytes_in(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

// Rounding of summed steps.
double tolerance_at(double t) {
  return 1e-9 * std::max(1.0, std::abs(t));
}

}  // namespace

DeviceStep shifted_to(double t, double h, DeviceStep step) {
  const double later = t - step.t;
  if (later != 0)
    for (std::size_t j = 0; j < step.sample.theta.size(); ++j)
      step.sample.theta[j] += later * step.sample.theta_dot[j];
  step.t = t;
  step.h = h;
  return step;
}

std::size_t bytes_of(const LabFrame& frame) {
  const RecordedFrame& r = frame.recorded;
  std::size_t bytes = sizeof(LabFrame) + bytes_in(r.values) + bytes_in(r.coupling_forces) +
                      bytes_in(r.contacts) + bytes_in(r.rows) + bytes_in(r.works) +
                      bytes_in(r.momentum_rows) + bytes_in(r.momenta) + r.memory.size() +
                      (frame.hand ? bytes_in(frame.hand->q_K) : 0) + bytes_in(frame.variants);
  for (const VariantFrame& variant : frame.variants)
    if (!variant.stopped) bytes += bytes_of(*variant.frame);  // a stopped one shares its last frame
  return bytes;
}

LabHistory::Frame LabHistory::add(LabFrame frame) {
  while (!frames_.empty() && frames_.back()->recorded.step >= frame.recorded.step) {
    bytes_ -= bytes_of(*frames_.back());
    frames_.pop_back();
  }
  if (segments_.empty()) segments_.push_back({frame.recorded.step, {}});
  bytes_ += bytes_of(frame);
  frames_.push_back(std::make_shared<const LabFrame>(std::move(frame)));
  trim();
  return frames_.back();
}

void LabHistory::add(const LabInput& input) {
  if (!input.hand && !input.mouse) return;
  while (!inputs_.empty() && inputs_.back().step >= input.step) {
    inputs_.pop_back();
    bytes_ -= sizeof(LabInput);
  }
  inputs_.push_back(input);
  bytes_ += sizeof(LabInput);
}

void LabHistory::begin_segment(std::vector<Change> changes) {
  const long step = empty() ? 0 : newest()->recorded.step;
  while (!segments_.empty() && segments_.back().first_step >= step) segments_.pop_back();
  segments_.push_back({step, std::move(changes)});
}

// Always leaves the newest frame.
void LabHistory::trim() {
  while (bytes_ > max_ && frames_.size() > 1) {
    bytes_ -= bytes_of(*frames_.front());
    frames_.pop_front();
    const long oldest = frames_.front()->recorded.step;
    while (!inputs_.empty() && inputs_.front().step <= oldest) {
      inputs_.pop_front();
      bytes_ -= sizeof(LabInput);
    }
    while (segments_.size() > 1 && segments_[1].first_step <= oldest) segments_.pop_front();
  }
}

std::size_t LabHistory::at(double t) const {
  const auto time_of = [](const Frame& frame) { return frame->recorded.t; };
  const auto later = std::ranges::upper_bound(frames_, t + tolerance_at(t), {}, time_of);
  return later == frames_.begin() ? 0 : static_cast<std::size_t>(later - frames_.begin()) - 1;
}

const LabInput* LabHistory::input(long step) const {
  const auto place = std::ranges::lower_bound(inputs_, step, {}, &LabInput::step);
  return place != inputs_.end() && place->step == step ? &*place : nullptr;
}

std::vector<LabInput> LabHistory::inputs_after(long step) const {
  return {std::ranges::lower_bound(inputs_, step + 1, {}, &LabInput::step), inputs_.end()};
}

const LabInput* LabHistory::input_at(double t) const {
  const double after = t + tolerance_at(t);
  const auto place = std::ranges::upper_bound(inputs_, after, std::less<>(),
                                              [](const LabInput& its) { return its.t + its.h; });
  return place != inputs_.end() && place->t <= after ? &*place : nullptr;
}

LabHistory LabHistory::cut(std::size_t n) {
  LabHistory left(max_);
  const long step = frames_[n]->recorded.step;
  left.segments_ = segments_;
  left.frames_.assign(frames_.begin() + static_cast<std::ptrdiff_t>(n), frames_.end());
  const auto later = std::ranges::lower_bound(inputs_, step + 1, {}, &LabInput::step);
  left.inputs_.assign(later, inputs_.end());
  for (const Frame& frame : left.frames_) left.bytes_ += bytes_of(*frame);
  left.bytes_ += left.inputs_.size() * sizeof(LabInput);
  bytes_ -= left.bytes_ - bytes_of(*frames_[n]);
  inputs_.erase(later, inputs_.end());
  frames_.resize(n + 1);
  while (segments_.size() > 1 && segments_.back().first_step > step) segments_.pop_back();
  return left;
}

// First step after the last change, switch of the input source, and mouse input.
long LabHistory::first_step_to_save() const {
  const long last = newest()->recorded.step, change = segments_.back().first_step;
  long step = last;
  if (input(last)) {
    for (const LabInput* its = input(step); its && its->hand && !its->mouse; its = input(step))
      --step;
  } else {
    while (step > change && !input(step)) --step;
  }
  return std::max(change, step);
}

// Contiguous operator steps up to the newest frame. Includes steps before the saved ones: couplings
// may have a delay.
std::string LabHistory::operator_log() const {
  const long last = newest()->recorded.step;
  long first = last + 1;
  for (const LabInput* its = input(last); its && its->hand; its = input(first - 1)) --first;
  std::string log = first <= last ? device_log_header() : "";
  for (long step = first; step <= last; ++step) log += device_log_line(*input(step)->hand);
  return log;
}

void LabHistory::save(const LabScene& scene, const LabNames& names,
                      const std::vector<std::size_t>& driven,
                      const std::filesystem::path& file) const {
  if (empty())
    throw InputError({{file.string(), 0, "save", "the run has no frames yet", "let it run",
                       "lab.nothing-saved"}});
  using recording_format::kMomentumName, recording_format::kName;
  const long first = first_step_to_save();
  RecordingHeader header = scene.header(segments_.back().changes, {driven, operator_log()});
  // Half a step beyond the last one, which then ends on the time grid.
  header.duration = newest()->recorded.t + 0.5 * header.step;
  header.run.duration = header.duration;
  RecordingWriter writer(file, std::move(header), /*keyframe_every=*/1);
  for (const Frame& one : frames_) {
    if (one->recorded.step < first) continue;
    RecordedFrame frame = one->recorded;
    frame.memory.resize(frame.memory.size() - one->outside_bytes);
    for (std::uint32_t& row : frame.rows) row = writer.number_of(kName, names.rows[row]);
    for (std::uint32_t& row : frame.momentum_rows)
      row = writer.number_of(kMomentumName, names.momentum_rows[row]);
    writer.write(frame);
  }
  writer.finish("saved");
}

}  // namespace twinarm
