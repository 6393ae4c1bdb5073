#include "app/support/parallel_for.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace twinarm {
namespace {

// Shared by the threads, under one lock.
struct SharedWork {
  std::mutex lock{};
  std::condition_variable news{};
  std::size_t next = 0, done = 0;
  unsigned running = 0;
  std::exception_ptr failure{};  // stops the loop
};

template <class Call>
std::exception_ptr failure_of(const Call& call) {
  try {
    call();
    return nullptr;
  } catch (...) {
    return std::current_exception();
  }
}

void work_off(std::size_t count, const std::function<void(std::size_t)>& one, SharedWork& work) {
  std::unique_lock held(work.lock);
  while (!work.failure && work.next < count) {
    const std::size_t mine = work.next++;
    held.unlock();
    const std::exception_ptr failure = failure_of([&] { one(mine); });
    held.lock();
    if (!failure)
      ++work.done;
    else if (!work.failure)
      work.failure = failure;
    work.news.notify_one();
  }
  --work.running;
  work.news.notify_one();
}

}  // namespace

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& one,
                  const std::function<void(std::size_t)>& tick, unsigned threads) {
  if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
  SharedWork work;
  work.running = static_cast<unsigned>(std::min<std::size_t>(threads, count));
  std::vector<std::thread> pool;
  for (unsigned i = work.running; i > 0; --i)
    pool.emplace_back([&] { work_off(count, one, work); });
  std::unique_lock held(work.lock);
  while (work.running > 0) {
    const std::size_t done = work.done;
    if (!work.failure) {
      held.unlock();
      const std::exception_ptr failure = failure_of([&] { tick(done); });
      held.lock();
      if (!work.failure) work.failure = failure;
    }
    work.news.wait_for(held, std::chrono::milliseconds(100),
                       [&] { return work.done > done || work.running == 0; });
  }
  held.unlock();
  for (std::thread& thread : pool) thread.join();
  if (work.failure) std::rethrow_exception(work.failure);
}

}  // namespace twinarm
