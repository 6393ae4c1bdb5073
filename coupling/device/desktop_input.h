// A hand that has no Omni: mouse, keyboard, game controller and space mouse move a place in the
// device's workspace, and that place is what the person's arm wants of the virtual Omni.
//
// Events come from one thread, whatever it is fed by; the virtual Omni asks from another. What
// moves on (a key that is held, a stick that is tilted) moves evenly in the time of the one who
// asks: neither thread has a clock, none waits for the other. A place out of reach or beyond the
// joints' ranges becomes the nearest that can be reached, at once: what was pushed too far need not
// be pulled back. Device axes: x right, y up, z to the user.
#pragma once

#include <atomic>

#include "coupling/device/omni.h"
#include "coupling/device/triple_buffer.h"
#include "coupling/target/operator_motion.h"

namespace twinarm {

// What keys, sticks and a space mouse move.
enum class HandAxis { right, up, toward, yaw, pitch, roll };

struct GestureSettings {
  double speed = 0.1, turn_rate = 1.5;  // of a key, or an axis at 1 [m/s], [rad/s]
  double dead_zone = 0.08;              // of axes, which never quite rest
  OmniAngles start{0, 0.7, 0.2, 0, 0.6, 0};
};

class DesktopInput final : public OperatorMotion {
 public:
  explicit DesktopInput(const OmniParameters& omni, const GestureSettings& settings = {});

  // For the thread of events, one at a time. What is not finite is not heard.
  void place(const Vector3& p) noexcept;         // there, device axes [m]
  void turn_stylus(const Vector3& by) noexcept;  // yaw, pitch, roll [rad]
  void key(HandAxis axis, bool positive, bool down) noexcept;
  void axes(const std::array<double, 6>& rates) noexcept;  // in [-1, 1], by HandAxis
  void button(std::size_t index, bool down) noexcept;      // 0: gripper, 1: clutch
  void release() noexcept;  // keys, axes and buttons: the window has lost its focus, a plug is out

  // For the thread of the virtual Omni.
  HandSample sample(double t, double toward) const override;
  double duration() const override;  // without end
  std::string description() const override {
    return "a place moved by mouse, keys or a game controller";
  }

 private:
  struct Goal {  // at the time t, and how it moves on
    double t = 0;
    Vector3 p = Vector3::Zero();
    std::array<double, 3> gimbal{};
    std::array<double, 6> rate{};  // by HandAxis
    std::array<bool, 2> buttons{};
  };
  OmniAngles angles(const Goal& goal, double t) const noexcept;
  void begin() noexcept;  // goal_ is brought to the newest time that was asked for
  void end() noexcept;    // and handed over, within reach

  OmniParameters omni_;
  GestureSettings settings_;
  Goal goal_;                                  // the events' own
  std::array<std::array<bool, 2>, 6> keys_{};  // held, by axis and direction
  std::array<double, 6> axes_{};
  mutable TripleBuffer<Goal> newest_;
  mutable std::atomic<double> asked_ = 0;  // the newest time that the virtual Omni has come to
};

}  // namespace twinarm
