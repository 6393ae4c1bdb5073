// One piece of work after another, on all processors.
#pragma once

#include <cstddef>
#include <functional>

namespace twinarm {

// Calls work(0) .. work(count - 1), each once, on so many threads (0: as many as there are
// processors). The caller's thread calls `tick` every now and then with how many are done. Both may
// throw: then no further piece begins, and the first exception is thrown here when all threads have
// ended.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& work,
                  const std::function<void(std::size_t)>& tick, unsigned threads = 0);

}  // namespace twinarm
