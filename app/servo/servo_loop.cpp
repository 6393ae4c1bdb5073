#include "app/servo/servo_loop.h"

#include <chrono>
#include <cmath>
#include <thread>

#include "app/servo/servo_clock.h"

namespace twinarm {
namespace {

// Ticks that may wait to be written: sixteen seconds of a thread that does not come.
constexpr std::size_t kRing = 1 << 14;

class Servo {
 public:
  Servo(LiveRun& run, const ServoPlan& plan, const std::atomic<bool>& stop)
      : run_(run), plan_(plan), stop_(stop), ring_(kRing) {}

  // The servo thread.
  void work() noexcept {
    if (plan_.ask_for_fifo) result_.refused = ask_for_real_time();
    const double ticks = plan_.duration / run_.step();
    const auto each_second = static_cast<long>(std::lround(1 / run_.step()));
    ServoClock clock(run_.step());
    clock.start();
    double last = 0, first = 0;
    long done = 0, total = 0;
    while (static_cast<double>(done) < ticks - 1e-9 && !stop_.load(std::memory_order_relaxed)) {
      const bool is_empty = plan_.control && (total / each_second) % 2 == 1;
      TickFigures& figures = is_empty ? result_.empty : result_.run;
      wait(clock, figures, last, total % each_second == 0);
      if (total == 0) first = last;
      const double cpu = thread_cpu_time();
      if (!is_empty) {
        const TickView view = run_.tick();
        ++done;
        if (!ring_.push(view)) ++result_.lost;
        if (!view.finite) result_.finite = false;
        if (!view.finite) break;
      }
      figures.cpu.add(thread_cpu_time() - cpu);
      figures.wall.add(monotonic_time() - last);
      if (clock.is_behind()) ++figures.overruns;
      ++total;
    }
    result_.span = last - first;
    done_.store(true, std::memory_order_release);
  }
  bool is_done() const { return done_.load(std::memory_order_acquire); }
  SpscRing<TickView>& ring() { return ring_; }
  ServoResult take() { return std::move(result_); }

 private:
  void wait(ServoClock& clock, TickFigures& figures, double& last, bool is_first_of_kind) noexcept {
    const ServoClock::Wake wake = clock.wait();
    const double now = monotonic_time();
    figures.late.add(wake.late);
    figures.slipped += wake.slipped;
    if (!is_first_of_kind) figures.interval.add(now - last);
    last = now;
  }

  LiveRun& run_;
  const ServoPlan& plan_;
  const std::atomic<bool>& stop_;
  SpscRing<TickView> ring_;
  ServoResult result_;
  std::atomic<bool> done_{false};
};

// As fast as it goes, in this thread.
ServoResult run_unpaced(LiveRun& run, const ServoPlan& plan, const std::atomic<bool>& stop,
                        const std::function<void(SpscRing<TickView>&)>& drain) {
  constexpr long kAtOnce = 100;
  SpscRing<TickView> ring(kAtOnce);
  ServoResult result;
  const double ticks = plan.duration / run.step() - 1e-9;
  for (long done = 0; static_cast<double>(done) < ticks && !stop && result.finite; ++done) {
    if (done % kAtOnce == 0) drain(ring);
    const TickView view = run.tick();
    result.finite = view.finite;
    ring.push(view);
  }
  drain(ring);
  return result;
}

}  // namespace

ServoResult run_servo(LiveRun& run, const ServoPlan& plan, const std::atomic<bool>& stop,
                      const std::function<void(SpscRing<TickView>&)>& drain) {
  if (!plan.real_time) return run_unpaced(run, plan, stop, drain);
  Servo servo(run, plan, stop);
  std::thread thread([&] { servo.work(); });
  while (!servo.is_done()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    drain(servo.ring());
  }
  thread.join();
  drain(servo.ring());
  return servo.take();
}

}  // namespace twinarm
