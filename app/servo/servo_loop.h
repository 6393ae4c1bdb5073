// The servo loop: a thread that ticks a run at the rate of its steps, and how punctual it was.
//
// The thread takes the newest state of the device and hands its force over; it waits for nobody but
// the clock. What it has done goes through a ring to the thread that writes files and talks to
// people.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/scene/forces/add_contacts.h"
#include "app/servo/haptic_loop.h"
#include "coupling/device/device_motion.h"
#include "coupling/device/input_device.h"
#include "solver/stepping/simulation.h"

namespace twinarm {

// A scene under a hand: one tick of the servo loop.
//
//   device.poll -> watch, mapping -> KVR -> one step of the DVR with contacts -> force ->
//   device.render
//
// tick() neither waits, throws nor allocates once warm. Time is that of the run: tick n stands at n
// h, in real time or not.
struct LiveOptions : HandLoopOptions {
  double step = 0;  // from 1e-6 to 0.1 s; 0: the scene's
};

// What a tick did, for the log and for whoever watches.
struct TickResult {
  HandStep hand;  // what the KVR was told
  DeviceWatchdog::Mode mode = DeviceWatchdog::Mode::live;
  std::array<double, 3> felt{};   // torques of the motors [N m]
  std::array<double, 3> error{};  // q_K - q_D of the driven joints at the start of the step
  bool finite = true;             // false: the DVR has left all bounds, and stands
};

class LiveRun {
 public:
  // Scene and device must outlive it. Throws InputError: a step beyond its range, an integrator
  // that is not semi-implicit, contact = "event", no coupling with target = "device", couplings
  // that follow the device with different joints, a mapping that cannot move them.
  LiveRun(const SceneModel& scene, HandDevice& device, const LiveOptions& options);

  TickResult tick() noexcept;
  double time() const { return simulation_.state().t; }
  double step() const { return h_; }
  const Simulation& simulation() const { return simulation_; }
  const SceneContacts& contacts() const { return *contacts_; }
  const DeviceWatchdog& watch() const { return loop_->watch(); }
  const DeviceMapping& mapping() const { return loop_->mapping(); }
  std::size_t leader() const { return leader_; }  // the first coupling that follows the device

 private:
  double h_;
  std::vector<std::size_t> led_;  // couplings that follow the device
  std::size_t leader_ = 0;
  std::unique_ptr<DeviceMotion> hand_;
  std::unique_ptr<SceneCouplings> couplings_;
  Simulation simulation_;
  std::optional<SceneContacts> contacts_;
  std::unique_ptr<HandLoop> loop_;
  bool stopped_ = false;
};

// What a device does for a while: its angles at each tick, as a hand that can be played again.

// At the device's own rate, for so many seconds. In real time, or as fast as it goes for a device
// that is simulated. Rates are differences; a device that is silent stands. No force is rendered.
// `tick` is called with the time that has gone, and may throw. Throws InputError for a device that
// says nothing in its first five seconds.
std::unique_ptr<DeviceMotion> record_hand(HandDevice& device, double duration, bool real_time,
                                          const std::function<void(double)>& tick);

// How long ticks took: a histogram that costs a few instructions to add to, and never allocates.
//
// Bins are a sixteenth of an octave wide, from 50 ns to 13 s; a quantile is the upper edge of its
// bin, so it is never told too small, and at most 4.5 % too large. The largest value is kept
// exactly.
class TickTimes {
 public:
  static constexpr int kBins = 28 * 16;
  static constexpr double kFirst = 50e-9;  // upper edge of the first bin [s]

  void add(double seconds) noexcept {
    const double bin = std::ceil(16 * std::log2(std::max(seconds, kFirst) / kFirst));
    ++counts_[static_cast<std::size_t>(std::min(bin, kBins - 1.0))];
    ++count_;
    sum_ += seconds;
    max_ = std::max(max_, seconds);
  }
  static double upper_edge(int bin) { return kFirst * std::exp2(bin / 16.0); }
  long count() const { return count_; }
  long count(int bin) const { return counts_[static_cast<std::size_t>(bin)]; }
  double largest() const { return max_; }
  double mean() const { return count_ ? sum_ / static_cast<double>(count_) : 0; }
  // The least edge that a share p of all values does not pass [s]; 0 where there are none.
  double quantile(double p) const {
    const double wanted = p * static_cast<double>(count_);
    long below = 0;
    for (int bin = 0; bin < kBins; ++bin) {
      below += count(bin);
      if (below > 0 && static_cast<double>(below) >= wanted) return std::min(upper_edge(bin), max_);
    }
    return max_;
  }

 private:
  std::array<long, kBins> counts_{};
  long count_ = 0;
  double sum_ = 0, max_ = 0;
};

// From one thread to another without a lock: a ring that one writes and one reads. A full ring
// refuses, it never waits.
template <class T>
class SpscRing {
 public:
  explicit SpscRing(std::size_t room) : slots_(room) {}
  // By the writer alone. False: there is no room, and the value is not taken.
  bool push(const T& value) noexcept {
    const std::size_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) == slots_.size()) return false;
    slots_[end % slots_.size()] = value;
    end_.store(end + 1, std::memory_order_release);
    return true;
  }
  // By the reader alone. False: there is nothing.
  bool pop(T& value) noexcept {
    const std::size_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == end_.load(std::memory_order_acquire)) return false;
    value = slots_[begin % slots_.size()];
    begin_.store(begin + 1, std::memory_order_release);
    return true;
  }

 private:
  std::vector<T> slots_;
  std::atomic<std::size_t> begin_{0}, end_{0};  // of all that were ever pushed
};

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
                      const std::function<void(SpscRing<TickResult>&)>& drain);

}  // namespace twinarm
