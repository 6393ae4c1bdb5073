// A loop on all processors.
#pragma once

#include <cstddef>
#include <functional>
#include <future>
#include <vector>

namespace twinarm {

// Calls work(0) .. work(count - 1) on `threads` threads (0: one per processor). The calling thread
// calls `tick` periodically with the number of finished calls. If either throws, no further call
// begins, and the first exception is rethrown when all threads have ended.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& work,
                  const std::function<void(std::size_t)>& tick, unsigned threads = 0);

// Result k is that of work(k): its get() returns the value or throws the exception.
template <class Work>
auto parallel_results(std::size_t count, const Work& work,
                      const std::function<void(std::size_t)>& tick) {
  using Result = decltype(work(count));
  std::vector<std::packaged_task<Result(std::size_t)>> tasks;
  std::vector<std::future<Result>> results;
  for (std::size_t k = 0; k < count; ++k)
    results.push_back(tasks.emplace_back(std::cref(work)).get_future());
  parallel_for(
      count, [&](std::size_t k) { tasks[k](k); }, tick);
  return results;
}

}  // namespace twinarm
