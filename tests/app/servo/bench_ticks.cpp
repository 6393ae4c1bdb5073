// Cost of a servo tick: the minimum processor time of each tick over several equal runs.
// Interrupts, other programs and wake-ups affect other ticks in each run.
//
//   bench_ticks [--scene FILE] [--device MOTION] [--duration S] [--runs N] [--cold KB] [--paced]
//               [--spin US]
//
// --cold KB   writes memory before each tick, for cold caches as after a sleep
// --paced     one run in real time, alternating each second with empty ticks and ticks of 20 us of
//             arithmetic in registers; what these take longer is due to the machine
// --spin US   busy-waits for the last US microseconds before each deadline
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "app/device/devices.h"
#include "app/scene/read/read_scene.h"
#include "app/servo/haptic_loop.h"
#include "app/servo/servo_loop.h"

namespace twinarm {
namespace {

struct TicksOptions {
  std::string scene = TWINARM_SOURCE_DIR "/assets/scenes/hand_and_obstacles.toml";
  std::string device = "virtual:synthetic:1";  // as of `twinarm hand`
  double duration = 60;
  int runs = 5;
  std::size_t cold = 0;  // [bytes]
  bool paced = false;
  double spin = 0;  // [s]
};

struct Tick {
  double cpu = 1e300;  // [s]
  int points = 0, impacts = 0;
  ImpulseReport impulses;
};

double quantile(std::vector<double> values, double p) {
  if (values.empty()) return 0;
  const auto place = static_cast<std::ptrdiff_t>(p * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

void print_line(const std::string& name, const std::vector<double>& seconds) {
  double sum = 0;
  for (const double s : seconds) sum += s;
  std::printf("%-26s %7zu %8.2f", name.c_str(), seconds.size(),
              1e6 * sum / static_cast<double>(std::max<std::size_t>(1, seconds.size())));
  for (const double p : {0.5, 0.9, 0.99, 0.999, 1.0})
    std::printf(" %8.2f", 1e6 * quantile(seconds, p));
  std::printf("\n");
}

void print_head() {
  std::printf("%-26s %7s %8s %8s %8s %8s %8s %8s\n", "processor time of a tick", "ticks", "mean us",
              "median", "p90", "p99", "p99.9", "largest");
}

std::vector<double> times_of(const std::vector<Tick>& ticks,
                             const std::function<bool(const Tick&)>& which) {
  std::vector<double> times;
  for (const Tick& tick : ticks)
    if (which(tick)) times.push_back(tick.cpu);
  return times;
}

// Ticks by a number; rare ones are put together at the end.
void print_by(const char* name, const std::vector<Tick>& ticks,
              const std::function<int(const Tick&)>& number) {
  constexpr int kMax = 12;
  std::printf("\n");
  for (int n = 0; n <= kMax; ++n) {
    const auto times = times_of(
        ticks, [&](const Tick& tick) { return n < kMax ? number(tick) == n : number(tick) >= n; });
    if (!times.empty())
      print_line(std::string(name) + " " + std::to_string(n) + (n < kMax ? "" : " or more"), times);
  }
}

void print_heaviest(std::vector<Tick> ticks, double step) {
  std::vector<std::size_t> order(ticks.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const std::size_t most = std::min<std::size_t>(order.size(), 20);
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(most), order.end(),
                    [&](std::size_t a, std::size_t b) { return ticks[a].cpu > ticks[b].cpu; });
  std::printf("\n%10s %8s %7s %8s %7s %7s %8s %5s\n", "t [s]", "us", "points", "impacts", "solved",
              "newton", "interior", "path");
  for (std::size_t i = 0; i < most; ++i) {
    const Tick& tick = ticks[order[i]];
    std::printf("%10.3f %8.2f %7d %8d %7d %7d %8d %5d\n", step * static_cast<double>(order[i]),
                1e6 * tick.cpu, tick.points, tick.impacts, tick.impulses.solved,
                tick.impulses.newton, tick.impulses.interior, tick.impulses.path);
  }
}

void note(const LiveRun& run, double cpu, Tick& tick) {
  tick.cpu = std::min(tick.cpu, cpu);
  const ContactConstraints* contacts = run.contacts().contacts();
  tick.points = contacts ? static_cast<int>(contacts->points().size()) : 0;
  tick.impacts = run.simulation().constraints().report().impacts;
  tick.impulses = run.simulation().constraints().report().step;
}

// Cost of reading the clock, part of every tick's figure.
std::vector<double> empty_ticks(std::size_t count) {
  std::vector<double> times;
  for (std::size_t i = 0; i < count; ++i) {
    const double before = thread_cpu_time();
    times.push_back(thread_cpu_time() - before);
  }
  return times;
}

void measure_unpaced(const SceneModel& scene, const TicksOptions& options) {
  std::vector<Tick> least;
  std::vector<double> once;
  std::vector<unsigned char> sweep(options.cold);
  State<double> end;
  double step = 0;
  for (int k = 0; k < options.runs; ++k) {
    const auto device = open_device(options.device);
    LiveRun run(scene, *device, {});
    step = run.step();
    least.resize(static_cast<std::size_t>(options.duration / step + 0.5));
    for (Tick& tick : least) {
      for (std::size_t i = 0; i < sweep.size(); i += 64) ++sweep[i];
      const double before = thread_cpu_time();
      run.tick();
      const double cpu = thread_cpu_time() - before;
      if (k == 0) once.push_back(cpu);
      note(run, cpu, tick);
    }
    if (k > 0 && (end.q != run.simulation().state().q || end.qd != run.simulation().state().qd))
      std::printf("the runs differ: their least is that of nothing\n");
    end = run.simulation().state();
  }
  print_head();
  print_line("empty", empty_ticks(least.size()));
  print_line("one run", once);
  print_line("least of " + std::to_string(options.runs),
             times_of(least, [](const Tick&) { return true; }));
  print_by("contact points", least, [](const Tick& tick) { return tick.points; });
  print_by("newton steps", least, [](const Tick& tick) { return tick.impulses.newton; });
  print_by("interior iterations", least, [](const Tick& tick) { return tick.impulses.interior; });
  print_by("impacts", least, [](const Tick& tick) { return tick.impacts; });
  print_heaviest(least, step);
}

// Sleeps until `spin` seconds before the deadline, then busy-waits.
void wait(double deadline, double spin) {
  const double until = deadline - spin;
  const timespec time{static_cast<time_t>(until),
                      static_cast<long>(1e9 * (until - std::floor(until)))};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr);
  while (monotonic_time() < deadline) {
  }
}

// Steps of a sum in registers that the compiler cannot shorten.
void add_up(long steps) {
  double x = 1;
  for (long i = 0; i < steps; ++i) x = x * 0.999999 + 1e-9;
  [[maybe_unused]] volatile double sum = x;  // against optimisation
}

// Number of steps of add_up() for that time without interrupts.
long steps_of(double seconds) {
  constexpr long kSteps = 10000;
  double least = 1e300;
  for (int i = 0; i < 100; ++i) {
    const double before = thread_cpu_time();
    add_up(kSteps);
    least = std::min(least, thread_cpu_time() - before);
  }
  return static_cast<long>(seconds / least * static_cast<double>(kSteps));
}

// Alternates seconds of ticks, empty ticks and arithmetic.
void measure_paced(const SceneModel& scene, const TicksOptions& options) {
  constexpr double kArithmetic = 20e-6;  // [s]
  const auto device = open_device(options.device);
  LiveRun run(scene, *device, {});
  const auto count = static_cast<std::size_t>(options.duration / run.step() + 0.5);
  const auto each_second = static_cast<long>(1 / run.step() + 0.5);
  const long steps = steps_of(kArithmetic);
  std::vector<Tick> ticks;
  std::vector<double> empty, arithmetic;
  for (auto* times : {&empty, &arithmetic}) times->reserve(count);
  ticks.reserve(count);
  double deadline = monotonic_time();
  for (long total = 0; ticks.size() < count; ++total) {
    wait(deadline += run.step(), options.spin);
    const long kind = total / each_second % 3;
    const double before = thread_cpu_time();
    if (kind == 0) run.tick();
    if (kind == 2) add_up(steps);
    const double cpu = thread_cpu_time() - before;
    if (kind == 0)
      note(run, cpu, ticks.emplace_back());
    else
      (kind == 1 ? empty : arithmetic).push_back(cpu);
  }
  print_head();
  print_line("empty, paced", empty);
  print_line("20 us of arithmetic, paced", arithmetic);
  print_line("paced", times_of(ticks, [](const Tick&) { return true; }));
  print_heaviest(ticks, run.step());
}

bool read_options(int argc, char** argv, TicksOptions& options) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view name = argv[i];
    if (name == "--paced") {
      options.paced = true;
      continue;
    }
    if (++i >= argc) return false;
    const char* const value = argv[i];
    if (name == "--scene")
      options.scene = value;
    else if (name == "--device")
      options.device = value;
    else if (name == "--duration")
      options.duration = std::atof(value);
    else if (name == "--runs")
      options.runs = std::max(1, std::atoi(value));
    else if (name == "--cold")
      options.cold = 1024 * static_cast<std::size_t>(std::atol(value));
    else if (name == "--spin")
      options.spin = 1e-6 * std::atof(value);
    else
      return false;
  }
  return options.duration > 0;
}

}  // namespace
}  // namespace twinarm

int main(int argc, char** argv) {
  using namespace twinarm;
  TicksOptions options;
  if (!read_options(argc, argv, options)) {
    std::fprintf(stderr, "bench_ticks: options as its first lines say\n");
    return 2;
  }
  const SceneModel scene = build_scene(read_scene(options.scene));
  if (options.paced)
    measure_paced(scene, options);
  else
    measure_unpaced(scene, options);
}
