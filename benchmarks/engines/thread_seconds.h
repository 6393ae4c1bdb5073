#pragma once

#include <ctime>

namespace twinarm::bench {

inline double thread_seconds() {  // CPU time of this thread [s]
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace twinarm::bench
