// `twinarm export`: a recording as CSV or JSON, or as a page (app/web).
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/command/command.h"
#include "app/command/parser/shared_options.h"
#include "app/data/json_writer.h"
#include "app/page/pages.h"
#include "app/record/output/recorded_output.h"
#include "app/support/files.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

struct ExportOptions {
  std::filesystem::path recording;
  std::filesystem::path page;  // an HTML file with all of the run; empty: text on stdout
  bool json = false, csv = false;
};

void add_options(CLI::App& command, ExportOptions& options) {
  add_file_option(command, "recording", options.recording, "of `twinarm simulate --record`")
      ->required();
  add_file_option(command, "page", options.page,
                  "write one HTML file: picture, plots, ledger, settings");
  add_json_option(command, options.json);
  command.add_flag("--csv", options.csv, "print one row a frame on stdout");
}

// Throws InputError with all faults of the options.
int export_page(const ExportOptions& options) {
  FaultList faults;
  if (options.csv)
    faults.add({"", 0, "--csv", "prints on stdout, and a page is asked for", "give one of them",
                "option.conflict"});
  const std::string file = options.page.string(), end = options.page.extension().string();
  if (end != ".html" && end != ".htm")
    faults.add({file, 0, "", "is no name of a page", "let it end in .html", "file.ending"});
  check_place(options.page, faults);
  faults.check();

  const ReplayPage page = replay_page(options.recording);
  write_whole_file(options.page, page.html);
  if (!options.json) {
    fmt::print("wrote {}: {} frames, {:.3g} a second, {:.2f} MB\n", file, page.frames, page.rate,
               1e-6 * static_cast<double>(page.html.size()));
    return 0;
  }
  fmt::print("{}\n", json_text({{"file", file},
                                {"frames", page.frames},
                                {"rate", page.rate},
                                {"bytes", page.html.size()}}));
  return 0;
}

int run_export(const ExportOptions& options) {
  if (!options.page.empty()) return export_page(options);
  if (options.json == options.csv)
    throw InputError({{"", 0, "--csv, --json", options.json ? "both are given" : "neither is given",
                       "give one of them, or the name of a page", "option.conflict"}});
  const Recording recording(options.recording);
  for (const std::string& note : recording.notes()) say("twinarm: {}\n", note);
  options.json ? print_recording_json(recording) : print_recording_csv(recording);
  return 0;
}

}  // namespace

Command export_command() {
  return {90, "export",
          "A recording as CSV or JSON, units in the headers, or as a page that "
          "replays it in any browser\n\n"
          "Example:  twinarm export out/run.twinrec out/run.html",
          add_options, run_export};
}

}  // namespace twinarm
