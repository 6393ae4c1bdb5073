// Checkpoint file of a map: lines with its identity, then a CSV table of finished cells. Work file,
// tile of a job array and merged map have the same format. The bytes depend only on which cells are
// present.
//
//   # twinarm map 2
//   # KEY VALUE                                            any number
//   ix,iy,stable,max_error,mean_error,energy,passivity     kMapMeasures; empty: no value
//   0,0,1,0.5,..                                           row by row, y upward
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/map/map_job.h"

namespace twinarm {

// Blocks of 16 x 16 cells (fewer at the upper edges), numbered row by row.
struct MapBlocks {
  static constexpr int kSide = 16;
  int nx = 0, ny = 0;  // cells of the map

  struct Block {
    int x0, x1, y0, y1;  // cells, the ends not included
  };
  int columns() const { return (nx + kSide - 1) / kSide; }
  int count() const { return columns() * ((ny + kSide - 1) / kSide); }
  Block operator[](int b) const;
};

struct TileFile {
  std::vector<std::string> head;                    // "KEY VALUE"
  std::map<std::pair<int, int>, CellValues> cells;  // by (iy, ix)

  std::string value_of(const std::string& key) const;  // empty if missing
  bool has_all_of(const MapBlocks::Block& block) const;
};

// Without cells.
TileFile empty_tile_file(const MapJob& job);

std::string to_text(const TileFile& file);
// Throws InputError if it is another kind of file, or damaged.
TileFile read_tile_file(const std::filesystem::path& path);

// Adds the cells of the file read from `path`. Throws InputError with all lines of the identity
// that differ from `into`, with cells outside the map, and with cells that have other values.
void add_cells(const TileFile& from, const MapBlocks& blocks, const std::filesystem::path& path,
               const std::string& fix, TileFile& into);
// The cells in `work`; with `force` none if it is not a file of this map.
TileFile resume_tile_file(const std::filesystem::path& work, const TileFile& empty,
                          const MapBlocks& blocks, bool force);
// All cells of a map from its tiles. Throws InputError if some are missing.
TileFile merge_tile_files(const std::vector<std::filesystem::path>& parts, const TileFile& empty,
                          const MapBlocks& blocks);

}  // namespace twinarm
