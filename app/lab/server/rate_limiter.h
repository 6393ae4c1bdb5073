// Limits a rate: evenly spaced events pass, and `burst` at once.
#pragma once

#include <algorithm>
#include <chrono>

namespace twinarm {

class RateLimiter {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // Until the next may pass [s]; 0: now.
  double wait(Time now) const {
    return std::max(0.0, std::chrono::duration<double>(next_ - now).count());
  }
  // One passes now, of at most `per_second`.
  void take(Time now, double per_second, double burst = 2) {
    const auto interval = [&](double count) {
      return std::chrono::duration_cast<Time::duration>(
          std::chrono::duration<double>(count / per_second));
    };
    next_ = std::max(next_, now - interval(burst - 1)) + interval(1);
  }
  // Whether one may pass now, and takes it.
  bool passes(Time now, double per_second, double burst = 2) {
    const bool is_free = wait(now) == 0;
    if (is_free) take(now, per_second, burst);
    return is_free;
  }

 private:
  Time next_{};
};

}  // namespace twinarm
