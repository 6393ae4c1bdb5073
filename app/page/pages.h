// HTML pages from templates: title, JSON and bytes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/data/json_writer.h"
#include "app/draw/scene_view.h"
#include "app/film/filmed_run.h"
#include "app/run/simulate_input.h"

namespace twinarm {

// Page of an inspected state: `inspect --json` with the robot (docs/use/share_a_run.md).
struct InspectedJson {
  std::string title, state;          // model and state
  std::vector<std::string> command;  // as typed
};

// `inspection`: from inspect_json(). Throws InputError if the program was built without templates.
std::string inspect_page(const SimulateInput& input, const State<double>& x,
                         const std::string& inspection, const InspectedJson& words);

// Page of a recorded run: one HTML file with 3D view, plots, energy balance and settings, without
// server or network (docs/use/share_a_run.md).
struct ReplayPage {
  std::string html;
  std::size_t frames = 0;
  double rate = 0;  // frames per second of the run
};

// Throws InputError if it is not a recording, or like inspect_page().
ReplayPage replay_page(const std::filesystem::path& recording);

// Settings of a run for its page: command, versions, options, couplings, bodies, files.

// Quoted for a shell; the program without its path.
std::string command_line(const std::vector<std::string>& words);

// Keys title, command, facts, tables, files, notes. `rate`: frames of the page per second.
void write_facts(JsonWriter& json, const FilmedRun& run, const SceneView& view, double rate);

}  // namespace twinarm
