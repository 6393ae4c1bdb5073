// The options of `twinarm zwidth`.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/command/commands.h"
#include "app/command/options.h"
#include "app/command/shared_options.h"

namespace twinarm {

void add_zwidth(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<ZwidthOptions>();
  CLI::App* zwidth = app.add_subcommand(
      "zwidth",
      "Walls that a hand device can render, alone, through a coupling and behind a delay\n\n"
      "Example:  twinarm zwidth --rate 1000 --damping 0.1 --svg zwidth.svg");
  zwidth->add_option("--mass", options->mass, "of the device at the hand [kg]")
      ->capture_default_str();
  zwidth->add_option("--damping", options->damping, "of the device [N s/m]")->capture_default_str();
  zwidth->add_option("--friction", options->friction, "of the device, Coulomb [N]")
      ->capture_default_str();
  zwidth->add_option("--resolution", options->resolution, "steps of its encoder [m]")
      ->capture_default_str();
  zwidth->add_option("--rate", options->rate, "of its loop [Hz]")->capture_default_str();
  zwidth->add_option("--delay", options->delay, "from sensor to motor [ticks]")
      ->capture_default_str();
  zwidth
      ->add_option("--wall-damping", options->wall_damping,
                   "of the wall whose largest stable stiffness is told [N s/m]")
      ->capture_default_str();
  zwidth->add_option("--seed", options->seed, "of the network and the synthetic hand")
      ->capture_default_str();
  add_file_option(*zwidth, "--svg", options->svg, "write the plane of K and B, and energies");
  add_file_option(*zwidth, "--png", options->png, "likewise, in pixels");
  zwidth->add_flag("--csv", options->csv, "print the walls as CSV on stdout");
  zwidth->add_flag("--json", options->json, "print one JSON object on stdout");
  zwidth->callback([options, &line] { line.chosen = [options] { return run_zwidth(*options); }; });
}

}  // namespace twinarm
