// Desktop input devices: mouse, keyboard, game controller and space mouse move a point in the
// workspace of the virtual Omni, which is the operator's goal for it.
//
// One thread writes events, the virtual Omni reads in another; neither waits. Motions at a rate (a
// pressed key, a deflected stick) advance with the reader's time. A point beyond the workspace or
// the joint limits is replaced by the nearest reachable one. Device axes: x right, y up, z to the
// user.
#pragma once

#include <algorithm>
#include <atomic>
#include <limits>

#include "coupling/device/omni.h"
#include "coupling/device/triple_buffer.h"
#include "coupling/target/operator_motion.h"

namespace twinarm {

// Axes of keys, sticks and a space mouse.
enum class DeviceAxis { right, up, toward, yaw, pitch, roll };

class DesktopInput final : public OperatorMotion {
 public:
  static constexpr OmniAngles kStart{0, 0.7, 0.2, 0, 0.6, 0};
  explicit DesktopInput(const OmniParameters& omni);

  // For the event thread. Values that are not finite are ignored.
  // Sets the point, device axes [m].
  void place(const Vector3& p) noexcept {
    if (p.allFinite()) update([&] { goal_.p = p; });
  }
  void rotate_stylus(const Vector3& by) noexcept;  // yaw, pitch, roll [rad]
  void key(DeviceAxis axis, bool positive, bool down) noexcept {
    update([&] { keys_[static_cast<std::size_t>(axis)][positive ? 1 : 0] = down; });
  }
  void axes(const std::array<double, 6>& rates) noexcept;  // in [-1, 1], by DeviceAxis
  // 0: gripper, 1: clutch
  void button(std::size_t index, bool down) noexcept {
    if (index < goal_.buttons.size()) update([&] { goal_.buttons[index] = down; });
  }
  // All keys, axes and buttons: focus lost or device unplugged.
  void release() noexcept {
    update([&] { keys_ = {}, axes_ = {}, goal_.buttons = {}; });
  }

  // For the thread of the virtual Omni, the only reader.
  OperatorSample sample(double t, double toward) const override;
  double duration() const override { return std::numeric_limits<double>::infinity(); }
  std::string description() const override {
    return "a point moved by mouse, keys or a game controller";
  }

 private:
  struct Goal {  // at the time t, and its rates
    double t = 0;
    Vector3 p = Vector3::Zero();
    std::array<double, 3> gimbal{};
    std::array<double, 6> rate{};  // by DeviceAxis
    std::array<bool, 2> buttons{};
  };
  OmniAngles angles(const Goal& goal, double t) const noexcept;
  void move_goal(double t) noexcept;  // to the time t, clamped to the workspace
  void publish() noexcept;
  template <class Change>
  void update(Change change) noexcept {
    const double t = last_t_.load(std::memory_order_relaxed);
    move_goal(t);
    goal_.t = std::max(t, goal_.t);
    change();
    publish();
  }

  OmniParameters omni_;
  Goal goal_;                                  // of the event thread
  std::array<std::array<bool, 2>, 6> keys_{};  // pressed, by axis and direction
  std::array<double, 6> axes_{};
  mutable TripleBuffer<Goal> newest_;
  mutable std::atomic<double> last_t_ = 0;  // newest time of a sample
};

}  // namespace twinarm
