// `twinarm zwidth`: measures the Z-width of a device (docs/understand/haptic_rendering.md).
#include <fmt/format.h>

#include "app/command/command.h"
#include "app/plot/gnuplot.h"
#include "app/support/files.h"
#include "app/support/progress.h"
#include "app/zwidth/zwidth.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

struct ZwidthOptions {
  SampledDevice device{.friction = 0.26, .resolution = 5.5e-5};
  double wall_damping = 1;  // [N s/m]
  unsigned seed = 1;
  std::filesystem::path svg, png;  // empty: none
  bool csv = false, json = false;
};

void add_options(const OptionAdder& add, ZwidthOptions& options) {
  add.group("Device");
  add("--mass", options.device.mass, "effective mass at the handle [kg]")->check(above_zero());
  add("--damping", options.device.damping, "viscous friction [N s/m]")->check(zero_or_more());
  add("--friction", options.device.friction, "Coulomb friction [N]")->check(zero_or_more());
  add("--resolution", options.device.resolution, "resolution of the encoder [m]")
      ->check(zero_or_more());
  add("--rate", options.device.rate, "rate of the haptic loop [Hz]")->check(between(1, 20000));
  add("--delay", options.device.delay, "delay from sensor to motor [ticks]")
      ->check(between(0, 1000));
  add.group("Measurement");
  add("--wall-damping", options.wall_damping,
      "damping B of the virtual wall at which the maximum stiffness is found [N s/m]")
      ->check(zero_or_more());
  add("--seed", options.seed, "random seed of network delays and operator motion");
  add.group("Output");
  add.output("--svg", options.svg, ".svg", "write the K-B plane and the energies as SVG");
  add.output("--png", options.png, ".png", "write the K-B plane and the energies as PNG");
  add("--csv", options.csv, "print the walls as CSV on stdout");
  add.json(options.json);
}

int run_zwidth(const ZwidthOptions& options) {
  if (options.json && options.csv)
    throw InputError("--csv", "cannot be combined with --json", "leave one of them out",
                     "option.conflict");
  if (!options.svg.empty() || !options.png.empty()) require_gnuplot();
  const SampledDevice& device = options.device;
  const std::filesystem::path assets = find_assets();
  Progress progress(false, Progress::kPatience);
  const Tell advance = [&](double part) { progress.advance(part, 1.0); };
  ZwidthResult result;
  progress.stage("walls", 0.5);
  result.walls = measure_walls(device, options.wall_damping, advance);
  progress.stage("K-B plane", 0.2);
  result.plane = measure_plane(device, advance);
  progress.stage("walls through a coupling", 0.05);
  result.series = measure_series(advance);
  progress.stage("delays", 0.15);
  result.delays = measure_delays(device, options.seed, advance);
  progress.stage("tracking", 0.1);
  result.follows = measure_follows(assets, options.seed, advance);
  if (!options.svg.empty()) write_whole_file(options.svg, zwidth_svg(result));
  if (!options.png.empty()) write_whole_file(options.png, zwidth_png(result));
  fmt::print("{}", options.json  ? zwidth_json(result) + "\n"
                   : options.csv ? zwidth_csv(result)
                                 : zwidth_table(result));
  print_wrote({options.svg, options.png}, options.json || options.csv);
  return 0;
}

}  // namespace

Command zwidth_command() {
  return {
      170, "zwidth",
      "Simulate a haptic device at virtual walls and find its Z-width: the stiffness and damping "
      "that it renders passively, also with coupling and delay\n\n"
      "Examples:\n"
      "  twinarm zwidth --rate 1000 --damping 0.1 --svg zwidth.svg\n"
      "  twinarm zwidth --mass 0.1 --delay 2 --json",
      add_options, run_zwidth};
}

}  // namespace twinarm
