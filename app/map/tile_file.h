// The file in which a map grows: lines that say what the map is of, then a CSV table of its
// finished cells. The work file of one machine, the tile of a job array and the joined map are all
// of this form. The bytes depend on which cells are there, and not on who computed them, when and
// in which order.
//
//   # twinarm map 2
//   # KEY VALUE                                            any number of such lines
//   ix,iy,stable,max_error,mean_error,energy,passivity     kMapMeasures; empty: has no value
//   0,0,1,0.5,..                                           row by row, y upward
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/map/map_job.h"

namespace twinarm {

// A map is cut into blocks of 16 x 16 cells (fewer at its far edges), numbered row by row: what
// parts of a map are made of.
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

  std::string value_of(const std::string& key) const;  // empty where there is no such line
  bool has_all_of(const MapBlocks::Block& block) const;
};

// Without cells.
TileFile empty_tile_file(const MapJob& job);
MapBlocks blocks_of(const MapJob& job);

std::string to_text(const TileFile& file);
// Throws InputError for what is no such file, or damaged.
TileFile read_tile_file(const std::filesystem::path& path);

// Takes over the cells of the file read from `path`. Throws InputError with all lines in which it
// is of another map than `into`, with cells that `blocks` does not have, or that differ.
void add_cells(const TileFile& from, const MapBlocks& blocks, const std::filesystem::path& path,
               const std::string& fix, TileFile& into);
// What an earlier call has left in `work`. `force`: nothing, where that is no file of this map.
TileFile resume_tile_file(const std::filesystem::path& work, const TileFile& empty,
                          const MapBlocks& blocks, bool force);
// All cells of a map, of the files of its parts. Throws InputError where some are missing.
TileFile merge_tile_files(const std::vector<std::filesystem::path>& parts, const TileFile& empty,
                          const MapBlocks& blocks);

}  // namespace twinarm
