// twinarm: the command line. Each command has a file of its own; this one knows their options.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "app/commands.h"
#include "app/interrupt.h"
#include "solver/fault.h"

namespace {

using namespace twinarm;

enum ExitCode { kDone = 0, kBadInput = 2, kInternal = 4, kInterrupted = 130 };

// All faults at once: on stderr for people, on stdout for machines too.
int tell(const InputError& error, bool as_json) {
  nlohmann::json errors = nlohmann::json::array();
  for (const Fault& fault : error.faults()) {
    fmt::print(stderr, "twinarm: {}\n", to_string(fault));
    errors.push_back({{"file", fault.file},
                      {"line", fault.line},
                      {"where", fault.where},
                      {"rule", fault.rule},
                      {"remedy", fault.remedy}});
  }
  if (as_json) fmt::print("{}\n", nlohmann::json{{"errors", errors}}.dump(1));
  return kBadInput;
}

void add_study(CLI::App& app, StudyOptions& options, std::function<int()>& command) {
  CLI::App* study =
      app.add_subcommand("study",
                         "The paper's study: E1 to E4, what explains them, and a report\n\n"
                         "Example:  twinarm study --out out/study");
  study->add_option("--out", options.out, "folder for report, figures, CSV")->capture_default_str();
  study
      ->add_option("--device", options.device,
                   "hand of E1 and E2: synthetic, or trace (default: trace if one is given)")
      ->check(CLI::IsMember({"synthetic", "trace"}));
  study->add_option("--seed", options.seed, "of the synthetic operator");
  study->add_option("--trace", options.trace, "CSV of a recorded hand, for E1 and E2");
  study->add_flag("--recalibrate", options.recalibrate,
                  "search the unpublished gains again and write them to the assets (minutes)");
  study->add_flag("--paper-view", options.paper_view,
                  "hide the ghost in pictures, as the paper does");
  study->add_flag("--json", options.json, "print one JSON object on stdout");
  study->add_option("--assets", options.assets, "folder of robots and settings (found by itself)");
  study->callback([&] { command = [&] { return run_study(options); }; });
}

void add_make_robot(CLI::App& app, std::string& recipe, std::function<int()>& command) {
  CLI::App* make = app.add_subcommand(
      "make-robot",
      "Make a robot's URDF and collision hulls from its CAD meshes and densities\n\n"
      "Example:  twinarm make-robot assets/robots/s103/robot.toml");
  make->add_option("recipe", recipe, "the robot's TOML recipe")->required();
  make->callback([&] { command = [&] { return run_make_robot(recipe); }; });
}

void add_trace(CLI::App& app, TraceOptions& options, std::function<int()>& command) {
  CLI::App* trace =
      app.add_subcommand("trace",
                         "Write the synthetic operator's hand as a CSV trace\n\n"
                         "Example:  twinarm trace --seed 1 --rate 200 --out hand.csv");
  trace->add_option("--seed", options.seed, "of the synthetic operator")->capture_default_str();
  trace->add_option("--duration", options.duration, "seconds")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  trace->add_option("--rate", options.rate, "samples per second")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  trace->add_option("--out", options.out, "CSV file")->required();
  trace->callback([&] { command = [&] { return run_trace(options); }; });
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"twinarm: a glass-box multibody laboratory\n\nExample:  twinarm study"};
  app.require_subcommand(1);
  StudyOptions study;
  TraceOptions trace;
  std::string recipe;
  std::function<int()> command;
  add_study(app, study, command);
  add_make_robot(app, recipe, command);
  add_trace(app, trace, command);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    const bool as_json =
        std::any_of(argv, argv + argc, [](std::string_view word) { return word == "--json"; });
    return tell(InputError({{"", 0, "command line", error.what(), "see twinarm --help"}}), as_json);
  }

  catch_interrupts();
  try {
    return command();
  } catch (const InputError& error) {
    return tell(error, study.json);
  } catch (const Interrupted&) {
    fmt::print(stderr, "twinarm: interrupted; nothing half-written was left behind\n");
    return kInterrupted;
  } catch (const std::exception& error) {
    fmt::print(stderr, "twinarm: internal fault: {}\n", error.what());
    return kInternal;
  }
}
