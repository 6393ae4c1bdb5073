// `twinarm zwidth`: checks its options, measures, writes (docs/hand_force.md).
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <optional>

#include "app/plot/gnuplot.h"
#include "app/support/interrupt.h"
#include "app/support/output_file.h"
#include "app/support/progress.h"
#include "app/zwidth/zwidth.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

// A bar for those who have waited for two seconds.
class Stages {
 public:
  void begin(const char* name, double weight) {
    name_ = name;
    weight_ = weight;
    if (bar_) bar_->stage(name_, weight_);
  }
  void operator()(double part) {
    check_interrupt();
    using Clock = std::chrono::steady_clock;
    if (!bar_ && Clock::now() - start_ > std::chrono::seconds(2)) {
      bar_.emplace(isatty(STDERR_FILENO) == 0);
      bar_->stage(name_, weight_);
    }
    if (bar_) bar_->advance(part);
  }

 private:
  const char* name_ = "";
  double weight_ = 0;
  std::optional<Progress> bar_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void check(const ZwidthOptions& options, FaultList& faults) {
  const auto number = [&](const char* name, double value, bool positive) {
    if (std::isfinite(value) && (positive ? value > 0 : value >= 0)) return;
    faults.add({"", 0, name,
                fmt::format("is {}, must be {}", value, positive ? "positive" : "0 or positive"),
                positive ? "give a positive number" : "give a number of at least 0"});
  };
  number("--mass", options.mass, true);
  number("--damping", options.damping, false);
  number("--friction", options.friction, false);
  number("--resolution", options.resolution, false);
  number("--rate", options.rate, true);
  number("--wall-damping", options.wall_damping, false);
  if (options.delay < 0 || options.delay > 1000)
    faults.add({"", 0, "--delay", fmt::format("is {} ticks", options.delay),
                "give a number from 0 to 1000"});
  for (const auto* file : {&options.svg, &options.png})
    if (!file->empty()) check_place(*file, faults);
  const auto ends = [&](const char* option, const std::filesystem::path& file, const char* with) {
    if (!file.empty() && file.extension() != with)
      faults.add({file.string(), 0, option, std::string("writes a file that ends in ") + with,
                  "give it that name"});
  };
  ends("--svg", options.svg, ".svg");
  ends("--png", options.png, ".png");
  if (options.json && options.csv)
    faults.add({"", 0, "--csv", "goes not with --json", "leave one of them out"});
}

}  // namespace

int run_zwidth(const ZwidthOptions& options) {
  FaultList faults;
  check(options, faults);
  faults.check();
  if (!options.svg.empty() || !options.png.empty()) require_gnuplot();
  SampledDevice device;
  device.mass = options.mass;
  device.damping = options.damping;
  device.friction = options.friction;
  device.resolution = options.resolution;
  device.rate = options.rate;
  device.delay = options.delay;
  const std::filesystem::path assets = find_assets();
  Stages stages;
  const Tell tell = [&](double part) { stages(part); };
  ZwidthResult result;
  stages.begin("walls", 0.5);
  result.walls = measure_walls(device, options.wall_damping, tell);
  stages.begin("plane of K and B", 0.2);
  result.plane = measure_plane(device, tell);
  stages.begin("walls through a coupling", 0.05);
  result.series = measure_series(tell);
  stages.begin("delays", 0.15);
  result.delays = measure_delays(device, options.seed, tell);
  stages.begin("robots under the hand", 0.1);
  result.follows = measure_follows(assets, options.seed, tell);
  if (!options.svg.empty()) write_whole_file(options.svg, zwidth_svg(result));
  if (!options.png.empty()) write_whole_file(options.png, zwidth_png(result));
  fmt::print("{}", options.json  ? zwidth_json(result)
                   : options.csv ? zwidth_csv(result)
                                 : zwidth_table(result));
  return 0;
}

}  // namespace twinarm
