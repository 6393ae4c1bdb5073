// The clock of a servo thread: absolute deadlines, a period apart, so that no lateness adds up.
//
// What a thread may do for its punctuality: SCHED_FIFO and memory that is never paged out. Both
// need a privilege (CAP_SYS_NICE, or limits in /etc/security/limits.conf); without it everything
// works, later at times.
#pragma once

#include <cstdint>
#include <string>

namespace twinarm {

class ServoClock {
 public:
  // Periods that the thread may be late by and still make up for, one tick at once after another.
  // Beyond it the deadlines begin anew from now: time has slipped.
  static constexpr int kMostBehind = 100;

  explicit ServoClock(double period);  // [s]
  // The first deadline is a period from now.
  void start() noexcept;
  struct Wake {
    double late = 0;  // after the deadline [s]
    int slipped = 0;  // periods that were given up
  };
  // Sleeps until the next deadline; returns at once where that has passed.
  Wake wait() noexcept;
  // Whether the next deadline has passed already: the tick took longer than there was.
  bool is_behind() const noexcept;

 private:
  std::int64_t period_, deadline_ = 0;  // [ns], of CLOCK_MONOTONIC
};

double monotonic_time() noexcept;   // [s]
double thread_cpu_time() noexcept;  // of the calling thread [s]

// Asks for SCHED_FIFO for the calling thread, and locks the memory of the program. What was not
// granted, with the remedy; empty where both were.
std::string ask_for_real_time();

}  // namespace twinarm
