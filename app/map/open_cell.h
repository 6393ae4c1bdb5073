// One cell of a map, opened: its scene as a file of its own, its recording.
#pragma once

#include <filesystem>
#include <string>

#include "app/map/map_job.h"

namespace twinarm {

struct OpenedCell {
  int ix = 0, iy = 0;
  double x = 0, y = 0;
  CellValues values{};
  std::filesystem::path scene;  // the scene with both numbers put in
  std::string command;          // of `twinarm simulate`, for the same run
};

// "IX,IY"; throws InputError for a cell that the map has not.
std::pair<int, int> parse_cell(const std::string& text, const MapJob& job);

// Writes the recording, and beside it the scene (its name, ending in .toml). Throws InputError.
OpenedCell open_cell(const MapJob& job, int ix, int iy, const std::filesystem::path& recording);

}  // namespace twinarm
