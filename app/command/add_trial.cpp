// The options of `twinarm trial`.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/command/commands.h"
#include "app/command/options.h"
#include "app/command/shared_options.h"

namespace twinarm {

void add_trial(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<TrialOptions>();
  CLI::App* trial = app.add_subcommand(
      "trial",
      "A protocol with a person: free motion and pick-and-place under torsional springs, linear "
      "springs, and the kinematic robot alone; a table at the end, and an anonymous CSV\n\n"
      "Example:  twinarm trial --device gamepad --seed 7");
  trial->add_option("--device", options->device, "as `twinarm hand --device list` has them")
      ->capture_default_str();
  trial->add_option("--mapping", options->mapping, "paper (theta1, 4, 6) or arm (theta1, 2, 3)")
      ->capture_default_str();
  trial->add_option("--conditions", options->conditions, "which robots, in this order")
      ->capture_default_str();
  trial->add_option("--tasks", options->tasks, "what is done with each")->capture_default_str();
  trial->add_option("--seed", options->seed, "draws the order of the conditions");
  trial->add_option("--subject", options->subject, "a code, not a name; left out: S1, S2, ...");
  trial->add_option("--seconds", options->seconds, "of free motion")
      ->check(above_zero())
      ->capture_default_str();
  trial->add_option("--most", options->most, "seconds that a pick-and-place may take")
      ->check(above_zero())
      ->capture_default_str();
  trial->add_flag("--feel", options->feel,
                  "let the hand feel the springs, on a device with motors (the paper does not)");
  trial->add_flag("--yes", options->yes, "begin without waiting for Enter");
  trial->add_flag("--simulated", options->simulated,
                  "no countdown, no waiting: for a virtual device");
  add_file_option(*trial, "--out", options->out, "folder of results.csv and of the logs")
      ->capture_default_str();
  trial->add_flag("--json", options->json, "print one JSON object on stdout");
  add_file_option(*trial, "--assets", options->assets,
                  "folder of robots and settings (found by itself)");
  trial->callback([options, &line] { line.chosen = [options] { return run_trial(*options); }; });
}

}  // namespace twinarm
