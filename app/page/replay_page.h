// The page of a recorded run: one HTML file with picture, plots, ledger and settings, that needs no
// server and no network (docs/replay_page.md).
#pragma once

#include <filesystem>
#include <string>

namespace twinarm {

struct ReplayPage {
  std::string html;
  std::size_t frames = 0;
  double rate = 0;  // frames per second of the run
};

// Throws InputError: no recording; the program was built without its pages.
ReplayPage replay_page(const std::filesystem::path& recording);

}  // namespace twinarm
