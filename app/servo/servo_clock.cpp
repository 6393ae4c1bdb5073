#include "app/servo/servo_clock.h"

#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>

namespace twinarm {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

std::int64_t nanoseconds_of(clockid_t clock) noexcept {
  timespec time{};
  clock_gettime(clock, &time);
  return time.tv_sec * kSecond + time.tv_nsec;
}

}  // namespace

ServoClock::ServoClock(double period)
    : period_(static_cast<std::int64_t>(std::llround(1e9 * period))) {}

void ServoClock::start() noexcept {
  deadline_ = nanoseconds_of(CLOCK_MONOTONIC) + period_;
}

ServoClock::Wake ServoClock::wait() noexcept {
  const timespec until{deadline_ / kSecond, deadline_ % kSecond};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
  const std::int64_t late = nanoseconds_of(CLOCK_MONOTONIC) - deadline_;
  Wake wake{1e-9 * static_cast<double>(late), 0};
  deadline_ += period_;
  if (late > kMostBehind * period_) {
    wake.slipped = static_cast<int>(late / period_);
    deadline_ += wake.slipped * period_;
  }
  return wake;
}

bool ServoClock::is_behind() const noexcept {
  return nanoseconds_of(CLOCK_MONOTONIC) > deadline_;
}

double monotonic_time() noexcept {
  return 1e-9 * static_cast<double>(nanoseconds_of(CLOCK_MONOTONIC));
}
double thread_cpu_time() noexcept {
  return 1e-9 * static_cast<double>(nanoseconds_of(CLOCK_THREAD_CPUTIME_ID));
}

std::string ask_for_real_time() {
  std::string missing;
  const sched_param priority{sched_get_priority_min(SCHED_FIFO) + 20};
  if (const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority))
    missing = fmt::format("SCHED_FIFO ({}: give the user an rtprio in /etc/security/limits.conf)",
                          std::strerror(error));
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0)
    missing += fmt::format("{}memory lock ({}: raise memlock in /etc/security/limits.conf)",
                           missing.empty() ? "" : ", ", std::strerror(errno));
  return missing;
}

}  // namespace twinarm
