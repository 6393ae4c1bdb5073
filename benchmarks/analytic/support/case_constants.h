// What nearly every case needs.
#pragma once

#include <numbers>

namespace twinarm {

inline constexpr double kGravity = 9.81;                   // [m/s^2]
inline constexpr double kDegree = std::numbers::pi / 180;  // [rad]

}  // namespace twinarm
