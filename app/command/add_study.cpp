// The options of `twinarm study`.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/command/commands.h"
#include "app/command/options.h"
#include "app/command/shared_options.h"

namespace twinarm {

void add_study(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<StudyOptions>();
  CLI::App* study =
      app.add_subcommand("study",
                         "The paper's study: E1 to E4, what explains them, and a report\n\n"
                         "Example:  twinarm study --out out/study");
  add_file_option(*study, "--out", options->out, "folder for report, figures, CSV")
      ->capture_default_str();
  study->add_option(
      "--device", options->device,
      "hand of E1 and E2: synthetic, trace (the default if one is given), or a device "
      "as `twinarm hand --device list` has them");
  study->add_option("--seed", options->seed, "of the synthetic operator");
  add_input_option(*study, "--trace", options->trace, "CSV of a recorded hand, for E1 and E2");
  study->add_flag("--recalibrate", options->recalibrate,
                  "search the unpublished gains again and write them to the assets (minutes)");
  study->add_flag("--identify", options->identify,
                  "ask again what the paper's Table 2 leaves open, and write it to the assets "
                  "(some ten minutes)");
  study->add_option("--ask", options->ask,
                    "ROW/LAW/RATE, as E4/linear/60: one question of --identify, answered on "
                    "stdout as JSON; nothing is written");
  study->add_flag("--paper-view", options->paper_view,
                  "hide the ghost in pictures, as the paper does");
  study->add_flag("--json", options->json, "print one JSON object on stdout");
  add_file_option(*study, "--assets", options->assets,
                  "folder of robots and settings (found by itself)");
  study->callback([options, &line] { line.chosen = [options] { return run_study(*options); }; });
}

}  // namespace twinarm
