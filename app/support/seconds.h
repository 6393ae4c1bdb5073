// Times of the clock that never jumps, in seconds.
#pragma once

#include <chrono>

namespace twinarm {

inline double as_seconds(std::chrono::steady_clock::duration time) noexcept {
  return std::chrono::duration<double>(time).count();
}
inline double steady_seconds() noexcept {
  return as_seconds(std::chrono::steady_clock::now().time_since_epoch());
}

}  // namespace twinarm
