// So many a second, and no more: what is evenly spaced goes on without a wait, and of what comes in
// a burst two may go at once. After a pause nothing is made up for.
#pragma once

#include <algorithm>
#include <chrono>

namespace twinarm {

class Allowance {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // Until the next may go [s]; 0: now.
  double wait(Time now) const {
    return std::max(0.0, std::chrono::duration<double>(next_ - now).count());
  }
  // One goes now, at so many a second.
  void take(Time now, double per_second) {
    const auto interval =
        std::chrono::duration_cast<Time::duration>(std::chrono::duration<double>(1 / per_second));
    next_ = std::max(next_, now - interval) + interval;
  }

 private:
  Time next_{};
};

}  // namespace twinarm
