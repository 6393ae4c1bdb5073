// A page from its template: title, JSON and bytes in their places.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/data/json_writer.h"
#include "app/page/channels.h"
#include "app/run/simulate_input.h"

namespace twinarm {

// Throws InputError where there is no template; `instead` says what else there is.
void require_form(std::string_view form, std::string_view missing, const std::string& instead);
std::string fill_form(std::string_view form, const std::string& title, const JsonWriter& json,
                      const PageBytes& bytes);

// The page of an inspected state: `inspect --json` with the robot beside it (docs/use/share_a_run.md).
struct InspectedJson {
  std::string title, state;          // what is looked at, and in which state
  std::vector<std::string> command;  // as it was typed
};

// `inspection`: what inspect_json() says. Throws InputError where the program was built without its
// pages.
std::string inspect_page(const SimulateInput& input, const State<double>& x,
                         const std::string& inspection, const InspectedJson& words);

// The page of a recorded run: one HTML file with picture, plots, ledger and settings, that needs no
// server and no network (docs/use/share_a_run.md).
struct ReplayPage {
  std::string html;
  std::size_t frames = 0;
  double rate = 0;  // frames per second of the run
};

// Throws InputError: no recording; the program was built without its pages.
ReplayPage replay_page(const std::filesystem::path& recording);

}  // namespace twinarm
