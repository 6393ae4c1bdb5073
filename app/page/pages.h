// HTML pages from templates: title, JSON and bytes.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/data/json_writer.h"
#include "app/page/channels.h"
#include "app/run/simulate_input.h"

namespace twinarm {

// Throws InputError if the program was built without templates; `instead`: an alternative.
void require_form(std::string_view form, std::string_view missing, const std::string& instead);
std::string fill_form(std::string_view form, const std::string& title, const JsonWriter& json,
                      const PageBytes& bytes);

// Page of an inspected state: `inspect --json` with the robot (docs/use/share_a_run.md).
struct InspectedJson {
  std::string title, state;          // model and state
  std::vector<std::string> command;  // as typed
};

// `inspection`: from inspect_json(). Throws InputError like require_form().
std::string inspect_page(const SimulateInput& input, const State<double>& x,
                         const std::string& inspection, const InspectedJson& words);

// Page of a recorded run: one HTML file with 3D view, plots, energy balance and settings, without
// server or network (docs/use/share_a_run.md).
struct ReplayPage {
  std::string html;
  std::size_t frames = 0;
  double rate = 0;  // frames per second of the run
};

// Throws InputError if it is not a recording, and like require_form().
ReplayPage replay_page(const std::filesystem::path& recording);

}  // namespace twinarm
