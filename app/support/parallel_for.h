// A loop on all processors.
#pragma once

#include <cstddef>
#include <functional>

namespace twinarm {

// Calls work(0) .. work(count - 1) on `threads` threads (0: one per processor). The calling thread
// calls `tick` periodically with the number of finished calls. If either throws, no further call
// begins, and the first exception is rethrown when all threads have ended.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& work,
                  const std::function<void(std::size_t)>& tick, unsigned threads = 0);

}  // namespace twinarm
