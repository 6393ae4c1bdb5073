#include "app/compare/compare.h"
#include "benchmarks/analytic/registry/analytic_cases.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace twinarm {
namespace {

// What the threads share, under one lock.
struct Work {
  std::mutex lock{};
  std::condition_variable news{};
  std::size_t next = 0, done = 0;
  bool stopped = false;
  std::exception_ptr failure{};
};

void work_off(std::size_t count, const std::function<void(std::size_t)>& one, Work& work) {
  std::unique_lock held(work.lock);
  while (!work.stopped && work.next < count) {
    const std::size_t mine = work.next++;
    held.unlock();
    std::exception_ptr failure;
    try {
      one(mine);
    } catch (...) {
      failure = std::current_exception();
    }
    held.lock();
    ++work.done;
    if (failure) work.failure = failure, work.stopped = true;
    work.news.notify_one();
  }
}

}  // namespace

CompareRow run_one(const AnalyticCase& test, const std::vector<Lane>& lanes) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  CompareRow row{&test, run_case(test), 0, {}};
  row.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (test.trajectory && test.trajectory->takes_lanes())
    for (const Lane& lane : lanes)
      row.lanes.push_back(
          {lane, run_lane(*test.trajectory, lane), observed_order(*test.trajectory, lane)});
  return row;
}

void two_at_a_time(std::size_t count, const std::function<void(std::size_t)>& one,
                   const std::function<void(std::size_t)>& tick) {
  Work work;
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < std::clamp(std::thread::hardware_concurrency(), 1U, 2U); ++i)
    threads.emplace_back([&] { work_off(count, one, work); });

  std::exception_ptr failure;
  try {
    std::unique_lock held(work.lock);
    while (work.done < count && !work.stopped) {
      const std::size_t done = work.done;
      held.unlock();
      tick(done);
      held.lock();
      work.news.wait_for(held, std::chrono::milliseconds(100),
                         [&] { return work.done > done || work.stopped; });
    }
  } catch (...) {
    failure = std::current_exception();
    const std::lock_guard held(work.lock);
    work.stopped = true;
  }
  for (std::thread& thread : threads) thread.join();
  if (!failure) failure = work.failure;
  if (failure) std::rethrow_exception(failure);
}

std::size_t failures(const std::vector<CompareRow>& rows) {
  return static_cast<std::size_t>(std::count_if(
      rows.begin(), rows.end(), [](const CompareRow& r) { return !passes(*r.test, r.result); }));
}

}  // namespace twinarm
