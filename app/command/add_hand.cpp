// The options of `twinarm hand`.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/command/commands.h"
#include "app/command/options.h"
#include "app/command/shared_options.h"

namespace twinarm {

void add_hand(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<HandOptions>();
  CLI::App* hand = app.add_subcommand(
      "hand",
      "A scene under a hand device, at 1 kHz in real time: the hand moves the kinematic robot and "
      "feels the springs\n\n"
      "Example:  twinarm hand assets/scenes/hand_and_obstacles.toml --duration 10 --timing");
  add_input_option(*hand, "scene", options->scene,
                   "TOML, with couplings whose target is \"device\"");
  hand->add_option("--device", options->device, "who moves it; `--device list` says what there is")
      ->capture_default_str();
  hand->add_option("--mapping", options->mapping,
                   "paper (theta1, 4, 6), arm (theta1, 2, 3) or cartesian")
      ->capture_default_str();
  hand->add_option("--scale", options->scale, "of cartesian: the robot's way over the hand's (4)")
      ->check(above_zero());
  hand->add_option("--force-scale", options->force_scale, "of what is felt (1)")
      ->check(zero_or_more());
  hand->add_option("--duration", options->duration, "seconds; left out: until Ctrl-C");
  hand->add_option("--step", options->step, "seconds, 1e-6 to 0.1; left out: the scene's")
      ->check(above_zero());
  hand->add_flag(
      "--simulated", options->simulated,
      "as fast as it goes: the same run on every machine, for a device that is simulated");
  hand->add_flag("--fifo", options->fifo,
                 "ask for the real-time scheduler and locked memory; goes on without them");
  hand->add_flag("--control", options->control,
                 "every other second an empty loop: what this machine can do at all");
  hand->add_flag("--timing", options->picture, "write OUT/timing.svg: histograms of the ticks");
  hand->add_flag("--record", options->record,
                 "make the run again from its log, and write OUT/run.twinrec");
  add_file_option(*hand, "--out", options->out, "folder of the log hand.csv and of what is made")
      ->capture_default_str();
  hand->add_flag("--json", options->json, "print one JSON object on stdout");
  hand->callback([options, &line] { line.chosen = [options] { return run_hand(*options); }; });
}

}  // namespace twinarm
