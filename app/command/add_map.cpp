// The options of `twinarm map`.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/command/commands.h"
#include "app/command/options.h"
#include "app/command/shared_options.h"

namespace twinarm {

void add_map(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<MapOptions>();
  CLI::App* map = app.add_subcommand(
      "map",
      "A plane of two numbers of a scene: stable or not, errors, energy; each cell is a run\n\n"
      "Example:  twinarm map assets/scenes/tracking_map.toml --x "
      "coupling.stiffness:1e4:1e6:64:log --y step:1e-3:1e-2:64:log --svg map.svg");
  add_input_option(*map, "scene", options->scene,
                   "a scene in TOML; with --merge it may be left out");
  map->add_option(
      "--x", options->x,
      "PATH:FROM:TO:N[:log]: a number of the scene file, its range, and how many cells");
  map->add_option("--y", options->y, "likewise, upward");
  map->add_option("--measure", options->measure, "stable max_error mean_error energy passivity")
      ->capture_default_str();
  map->add_option("--of", options->of, "the coupling whose joints' errors are measured; the first");
  map->add_option("--duration", options->duration,
                  "seconds; if not given, as long as the scene says");
  map->add_option("--step", options->step, "seconds; the scene's if not given");
  map->add_option("--integrator", options->integrator, "the scene's if not given");
  add_file_option(*map, "--svg", options->svg, "write a picture with the limits of theory on top");
  add_file_option(*map, "--png", options->png, "likewise, in pixels");
  add_file_option(*map, "--csv", options->csv, "write a row for each cell, with all measures");
  add_file_option(*map, "--work", options->work,
                  "the file that keeps what is finished, and from which a killed map goes on; "
                  "below out/map if not given");
  map->add_option("--tiles", options->tiles, "how many machines share the map");
  map->add_option("--tile", options->tile, "which part this one computes, from 0; no picture");
  add_file_option(*map, "--merge", options->merge, "join these files of --tile");
  map->add_option("--cell", options->cell, "IX,IY: open a cell, from 0");
  add_file_option(*map, "--record", options->record,
                  "of that cell: its recording; its scene goes beside");
  map->add_flag("--alone", options->alone,
                "run each cell by itself, as simulate does, where cells could run side by side");
  map->add_option("--threads", options->threads, "all processors if not given");
  map->add_flag("--force", options->force, "write over files that are there");
  map->add_flag("--json", options->json, "print one JSON object on stdout");
  map->callback([options, &line] { line.chosen = [options] { return run_map(*options); }; });
}

}  // namespace twinarm
