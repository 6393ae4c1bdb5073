// Options of `twinarm map`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace twinarm {

struct MapOptions {
  std::filesystem::path scene;
  std::string x, y;                      // PATH:FROM:TO:N[:log]
  std::string measure = "stable", of;    // `of`: a coupling's name; empty: the first
  std::optional<double> duration, step;  // [s]; left out: as the scene says
  std::string integrator;
  std::filesystem::path svg, png, csv;  // empty: none
  std::filesystem::path work;           // where finished blocks are kept; empty: below out/map
  int tiles = 0, tile = -1;             // one part of many
  std::vector<std::filesystem::path> merge;
  std::string cell;              // "IX,IY", opened
  std::filesystem::path record;  // its recording
  unsigned threads = 0;          // 0: all processors
  bool alone = false;            // each cell by itself, as `simulate` runs it
  bool force = false, json = false;
};

}  // namespace twinarm
