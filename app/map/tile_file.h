// The file in which a map grows: what the map is of, in lines that a person can read, then its
// finished blocks (app/map/map_blocks.h). The work file of one machine, the tile of a job array and
// the joined map are all of this form. The bytes depend on which blocks are there, and not on who
// computed them, when and in which order.
//
//   twinarm map 1 <newline>  KEY VALUE <newline> ..  <newline>
//   then for each block, ascending: uint32 number, uint32 doubles, all measures of each cell (the
//   order of kMapMeasures), row by row (y upward), uint64 FNV-1a of all that; little-endian. What
//   has no value is a NaN.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/map/map_blocks.h"
#include "app/map/map_job.h"

namespace twinarm {

struct TileFile {
  std::vector<std::string> head;              // "KEY VALUE"
  std::map<int, std::vector<double>> blocks;  // by number; kMapMeasures.size() for each cell

  std::string value_of(const std::string& key) const;  // empty where there is no such line
};

// Without blocks.
TileFile empty_tile_file(const MapJob& job);
MapBlocks blocks_of(const MapJob& job);

std::string to_bytes(const TileFile& file);
// Throws InputError for what is no such file, or damaged.
TileFile read_tile_file(const std::filesystem::path& path);

// All lines in which the file at `path` is of another map than `wanted`, as faults.
void check_same_map(const TileFile& found, const TileFile& wanted,
                    const std::filesystem::path& path, const std::string& remedy,
                    FaultList& faults);
// Takes over the blocks of a file that has passed check_same_map; adds faults where their sizes are
// not the map's, or two files differ in a block.
void add_blocks(const TileFile& from, const MapBlocks& blocks, const std::filesystem::path& path,
                TileFile& into, FaultList& faults);
// What an earlier call has left in `work`. `force`: nothing, where that is no file of this map.
TileFile resume_tile_file(const std::filesystem::path& work, const TileFile& empty,
                          const MapBlocks& blocks, bool force);
// All blocks of a map, of the files of its parts. Throws InputError where some are missing.
TileFile merge_tile_files(const std::vector<std::filesystem::path>& parts, const TileFile& empty,
                          const MapBlocks& blocks);

}  // namespace twinarm
