#include "app/lab/run/lab_input_device.h"

#include <cmath>
#include <utility>

#include "app/device/devices.h"

namespace twinarm {

LabHand::LabHand() {
  mapping_.kind = MappingKind::cartesian;
  mapping_.scale = 5;
  // What a mouse drags is held by a soft arm: with the power of virtual work, 25 times as stiff, it
  // would buzz against its motors' limit. So the stylus feels a fifth of the force on the tip.
  mapping_.force_scale = 1 / (mapping_.scale * mapping_.scale);
  // And not each millisecond's damping: held for a step, 300 N s/m on 0.15 kg would swing to and
  // fro.
  force_.cutoff = 15;
}

void LabHand::choose(Source source, const std::string& spec) {
  std::shared_ptr<GestureHand> gestures;
  std::unique_ptr<HandDevice> device;
  if (source == Source::device) device = open_device(spec);
  if (source == Source::drag) {
    VirtualOmniSettings settings;
    // No encoders: their counts, magnified and divided by a millisecond, are felt in every damper.
    settings.figures.resolution = 0;
    gestures = std::make_shared<GestureHand>(settings.figures);
    device = std::make_unique<VirtualOmni>(gestures, settings);
    gestures->button(0, gripper_);
  }
  device_ = std::move(device);
  gestures_ = std::move(gestures);
  source_ = source;
  spec_ = source == Source::device ? spec : "";
  tip_.reset();
  joints_.clear();
  ++chosen_;
}

std::string LabHand::description() const {
  if (device_) return device_->description();
  return source_ == Source::joints ? "driven joint by joint" : "as the scene says";
}

void LabHand::tip(const Vector3& goal_W, double stamp) {
  if (!goal_W.allFinite()) return;
  tip_ = goal_W;
  stamp_ = stamp;
}

void LabHand::joint(std::size_t driven, double value, double stamp) {
  constexpr std::size_t kMost = 64;
  if (driven >= kMost || !std::isfinite(value)) return;
  if (joints_.size() <= driven) joints_.resize(driven + 1);
  joints_[driven] = value;
  stamp_ = stamp;
}

void LabHand::turn(double yaw, double pitch, double roll, double stamp) {
  if (gestures_) gestures_->turn_stylus({yaw, pitch, roll});
  stamp_ = stamp;
}

void LabHand::axes(const std::array<double, 6>& rates, double stamp) {
  tip_.reset();  // they move on from where the stylus is
  if (gestures_) gestures_->axes(rates);
  stamp_ = stamp;
}

void LabHand::button(std::size_t index, bool down, double stamp) {
  if (index == 0) gripper_ = down;
  if (gestures_) gestures_->button(index, down);
  stamp_ = stamp;
}

void LabHand::release() {
  tip_.reset();
  if (!gestures_) return;
  gestures_->release();
  gestures_->button(0, gripper_);
}

}  // namespace twinarm
