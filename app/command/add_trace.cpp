// The options of `twinarm trace`.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/command/commands.h"
#include "app/command/options.h"
#include "app/command/shared_options.h"

namespace twinarm {

void add_trace(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<TraceOptions>();
  CLI::App* trace =
      app.add_subcommand("trace",
                         "Write the synthetic operator's hand as a CSV trace\n\n"
                         "Example:  twinarm trace --seed 1 --rate 200 --out hand.csv");
  trace->add_option("--seed", options->seed, "of the synthetic operator")->capture_default_str();
  trace->add_option("--duration", options->duration, "seconds")
      ->check(above_zero())
      ->capture_default_str();
  trace->add_option("--rate", options->rate, "samples per second")
      ->check(above_zero())
      ->capture_default_str();
  add_file_option(*trace, "--out", options->out, "CSV file")->required();
  trace->callback([options, &line] { line.chosen = [options] { return run_trace(*options); }; });
}

}  // namespace twinarm
