// The servo loop: a thread that ticks a run at the rate of its steps, and how punctual it was.
//
// The thread takes the newest state of the device and hands its force over; it waits for nobody but
// the clock. What it has done goes through a ring to the thread that writes files and talks to
// people.
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "app/servo/servo_run.h"
#include "app/servo/spsc_ring.h"
#include "app/servo/tick_times.h"

namespace twinarm {

// How the ticks of one kind went.
struct TickFigures {
  TickTimes late;      // the thread woke after the deadline by this much
  TickTimes interval;  // between the beginnings of neighbouring ticks
  TickTimes cpu;       // of the thread, in the tick
  TickTimes wall;      // of the tick
  long overruns = 0;   // ticks that were not done by the next deadline
  long slipped = 0;    // periods that were given up
};

struct ServoPlan {
  double duration = 0;    // of ticks that step the run [s]; infinite: until told
  bool real_time = true;  // false: as fast as it goes, and no figures of punctuality
  bool ask_for_fifo = false;
  // Each other second the ticks are empty: what this machine can do at all, beside what we do.
  bool control = false;
};

struct ServoResult {
  TickFigures run, empty;
  std::string refused;  // what real-time privileges were asked for and not given
  long lost = 0;        // ticks that the ring had no room for
  double span = 0;  // from the beginning of the first tick to that of the last, by the clock [s]
  bool finite = true;
};

// Runs until its duration is over or `stop` says true (asked each tick by the servo thread: a
// flag). `drain` is called by this thread, some twenty times a second and once at the end, with the
// ring. In real time it must not throw.
ServoResult run_servo(LiveRun& run, const ServoPlan& plan, const std::atomic<bool>& stop,
                      const std::function<void(SpscRing<TickView>&)>& drain);

}  // namespace twinarm
