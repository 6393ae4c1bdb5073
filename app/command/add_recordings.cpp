// The options of `twinarm export` and `twinarm replay`.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/command/commands.h"
#include "app/command/options.h"
#include "app/command/shared_options.h"

namespace twinarm {

void add_recordings(CLI::App& app, CommandLine& line) {
  const auto exported = std::make_shared<ExportOptions>();
  const auto replayed = std::make_shared<ReplayOptions>();
  CLI::App* out =
      app.add_subcommand("export",
                         "A recording as CSV or JSON, units in the headers, or as a page that "
                         "replays it in any browser\n\n"
                         "Example:  twinarm export out/run.twinrec out/run.html");
  add_file_option(*out, "recording", exported->recording, "of `twinarm simulate --record`")
      ->required();
  add_file_option(*out, "page", exported->page,
                  "write one HTML file: picture, plots, ledger, settings");
  out->add_flag("--json", exported->json, "print one JSON object on stdout");
  out->add_flag("--csv", exported->csv, "print one row a frame on stdout");
  out->callback([exported, &line] { line.chosen = [exported] { return run_export(*exported); }; });
  CLI::App* replay = app.add_subcommand(
      "replay",
      "Run on from a recorded step: the same bits; or, with --set, a fork\n\n"
      "Example:  twinarm replay out/run.twinrec --from 0.5 --set coupling.stiffness=800");
  add_file_option(*replay, "recording", replayed->recording, "of `twinarm simulate --record`")
      ->required();
  replay->add_option("--from", replayed->from, "seconds; the start if not given");
  replay->add_option("--set", replayed->changes, "PATH=VALUE of the scene, for a fork")
      ->allow_extra_args(false);
  add_file_option(*replay, "--plot", replayed->plot, "an SVG of both branches");
  replay->add_flag("--json", replayed->json, "print one JSON object on stdout");
  replay->callback(
      [replayed, &line] { line.chosen = [replayed] { return run_replay(*replayed); }; });
}

}  // namespace twinarm
