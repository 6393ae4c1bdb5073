// Servo loop: a thread that ticks a run in real time at the rate of its steps, and measures its
// timing.
//
// The thread waits only for its clock. Results of its ticks go through a ring to the thread that
// writes files and output.
#pragma once

#include <atomic>

#include "app/scene/forces/add_contacts.h"
#include "app/servo/haptic_loop.h"
#include "coupling/device/device_motion.h"

namespace twinarm {

// One tick: device.poll -> watchdog, mapping -> KVR -> one step of the DVR with contacts -> force
// -> device.render. tick() does not block, throw or, once warm, allocate. Tick n is at run time n
// h.
struct LiveOptions : HapticLoopOptions {
  double step = 0;  // from 1e-6 to 0.1 s; 0: the scene's
};

struct TickResult {
  DeviceStep motion;  // of the KVR
  DeviceWatchdog::Mode mode = DeviceWatchdog::Mode::live;
  std::array<double, 3> motor_torques{};  // [N m]
  std::array<double, 3> error{};          // q_K - q_D of the driven joints at the start of the step
  bool finite = true;  // false: the DVR has diverged, and is not stepped any more
};

class LiveRun {
 public:
  // Scene and device must outlive it. Throws InputError: step out of range, integrator not
  // semi-implicit, contact = "event", no coupling with target = "device", such couplings with
  // different driven joints, a mapping that cannot move them.
  LiveRun(const SceneModel& scene, InputDevice& device, const LiveOptions& options);

  TickResult tick() noexcept;
  double time() const { return simulation_.state().t; }
  double step() const { return h_; }
  const Simulation& simulation() const { return simulation_; }
  const SceneContacts& contacts() const { return *contacts_; }
  const DeviceWatchdog& watch() const { return loop_->watch(); }
  const DeviceMapping& mapping() const { return loop_->mapping(); }
  std::size_t leader() const { return driven_.front(); }  // first coupling of the device

 private:
  double h_;
  std::vector<std::size_t> driven_;  // couplings with target = "device"
  std::unique_ptr<DeviceMotion> hand_;
  std::unique_ptr<SceneCouplings> couplings_;
  Simulation simulation_;
  std::optional<SceneContacts> contacts_;
  std::unique_ptr<HapticLoop> loop_;
  bool stopped_ = false;
};

// Records the motion of a device at its own rate for `duration` [s]; simulated devices may run
// faster than real time. Rates are differences; while the device is silent it is at rest. No force
// is rendered. `tick` gets the elapsed time, and may throw. Throws InputError: no data in five
// seconds.
std::unique_ptr<DeviceMotion> record_operator(InputDevice& device, double duration, bool real_time,
                                              const std::function<void(double)>& tick);

// Histogram of durations, without allocation. Bins are 1/16 octave wide, from 50 ns to 13 s; a
// quantile is the upper edge of its bin, at most 4.5 % too large. The maximum is exact.
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
  double max() const { return max_; }
  double mean() const { return count_ ? sum_ / static_cast<double>(count_) : 0; }
  // Upper edge below which a share p of the values lies [s]; 0: no values.
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

// Lock-free ring buffer, single producer, single consumer.
template <class T>
class SpscRing {
 public:
  explicit SpscRing(std::size_t size) : slots_(size) {}
  // From the producer. False: full.
  bool push(const T& value) noexcept {
    const std::size_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) == slots_.size()) return false;
    slots_[end % slots_.size()] = value;
    end_.store(end + 1, std::memory_order_release);
    return true;
  }
  // From the consumer. False: empty.
  bool pop(T& value) noexcept {
    const std::size_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == end_.load(std::memory_order_acquire)) return false;
    value = slots_[begin % slots_.size()];
    begin_.store(begin + 1, std::memory_order_release);
    return true;
  }

 private:
  std::vector<T> slots_;
  std::atomic<std::size_t> begin_{0}, end_{0};  // counts of all values
};

struct TickFigures {
  TickTimes late;      // wake-up after the deadline
  TickTimes interval;  // between the starts of consecutive ticks
  TickTimes cpu;       // processor time of the tick
  TickTimes wall;      // wall time of the tick
  long overruns = 0;   // deadline misses
  long slipped = 0;    // skipped periods
};

struct ServoPlan {
  double duration = 0;    // of ticks that step the run [s]; may be infinite
  bool real_time = true;  // false: without pacing and timing figures
  bool ask_for_fifo = false;
  bool empty_loop =
      false;  // every other second the ticks are empty, to measure the machine's jitter
};

struct ServoResult {
  TickFigures run, empty;
  std::string refused;  // requested real-time privileges that were denied
  long lost = 0;        // ticks that did not fit into the ring
  double span = 0;      // from the start of the first tick to that of the last [s]
  bool finite = true;
};

// Runs for its duration or until `stop`. The calling thread calls `drain` with the ring about
// twenty times a second and once at the end; in real time it must not throw.
ServoResult run_servo(LiveRun& run, const ServoPlan& plan, const std::atomic<bool>& stop,
                      const std::function<void(SpscRing<TickResult>&)>& drain);

}  // namespace twinarm
