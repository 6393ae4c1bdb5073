#include "coupling/device/desktop_input.h"

#include <cmath>

namespace twinarm {
namespace {

constexpr double kSpeed = 0.1, kAngularSpeed = 1.5;  // of a key, or an axis at 1 [m/s], [rad/s]
constexpr double kDeadZone = 0.08;                   // of axes

}  // namespace

DesktopInput::DesktopInput(const OmniParameters& omni) : omni_(omni), newest_(Goal{}) {
  goal_.p = omni_position(omni_, kStart);
  std::copy_n(kStart.begin() + 3, 3, goal_.gimbal.begin());
  publish();
}

OmniAngles DesktopInput::angles(const Goal& goal, double t) const noexcept {
  const double dt = std::max(t - goal.t, 0.0);
  const Vector3 p = goal.p + dt * Vector3(goal.rate[0], goal.rate[1], goal.rate[2]);
  const auto arm = omni_nearest(omni_, p);
  OmniAngles theta{arm[0], arm[1], arm[2]};
  for (std::size_t j = 3; j < 6; ++j)
    theta[j] = std::clamp(goal.gimbal[j - 3] + dt * goal.rate[j], omni_.lower[j], omni_.upper[j]);
  return theta;
}

OperatorSample DesktopInput::sample(double t, double /*toward*/) const {
  if (t > last_t_.load(std::memory_order_relaxed)) last_t_.store(t, std::memory_order_relaxed);
  const Goal& goal = newest_.read();
  OperatorSample sampled;
  sampled.theta = angles(goal, t);
  sampled.button = goal.buttons[0];
  sampled.clutch = goal.buttons[1];
  if (goal.rate == std::array<double, 6>{}) return sampled;
  constexpr double kAhead = 1e-6;  // [s]; finite difference, also along the workspace boundary
  const OmniAngles next = angles(goal, t + kAhead);
  for (std::size_t j = 0; j < 6; ++j) sampled.theta_dot[j] = (next[j] - sampled.theta[j]) / kAhead;
  return sampled;
}

void DesktopInput::move_goal(double t) noexcept {
  const OmniAngles theta = angles(goal_, t);
  goal_.p = omni_position(omni_, theta);
  std::copy_n(theta.begin() + 3, 3, goal_.gimbal.begin());
}

void DesktopInput::publish() noexcept {
  move_goal(goal_.t);
  for (std::size_t j = 0; j < 6; ++j) {
    const double keys = (keys_[j][1] ? 1.0 : 0.0) - (keys_[j][0] ? 1.0 : 0.0);
    const double rate = std::clamp(keys + axes_[j], -1.0, 1.0);
    goal_.rate[j] = rate * (j < 3 ? kSpeed : kAngularSpeed);
  }
  newest_.write(goal_);
}

void DesktopInput::rotate_stylus(const Vector3& by) noexcept {
  if (!by.allFinite()) return;
  update([&] {
    for (std::size_t j = 0; j < 3; ++j) goal_.gimbal[j] += by[static_cast<Eigen::Index>(j)];
  });
}

void DesktopInput::axes(const std::array<double, 6>& rates) noexcept {
  update([&] {
    for (std::size_t j = 0; j < 6; ++j) {
      const double rate = std::isfinite(rates[j]) ? std::clamp(rates[j], -1.0, 1.0) : 0.0;
      const double beyond = (std::abs(rate) - kDeadZone) / (1 - kDeadZone);
      axes_[j] = beyond > 0 ? std::copysign(beyond, rate) : 0.0;
    }
  });
}

}  // namespace twinarm
