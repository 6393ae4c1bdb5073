// Computes the blocks of a map that are missing, on all cores, and keeps what is finished.
#pragma once

#include <filesystem>
#include <vector>

#include "app/map/map_job.h"
#include "app/map/tile_file.h"

namespace twinarm {

struct ComputeOptions {
  unsigned threads = 0;  // 0: as many as there are processors
  bool quiet = false;    // no progress
};

// `wanted`: numbers of blocks. Those that the file already has are left as they are; the others are
// added, and the file is written to `work` every second or so and at the end: also where
// Interrupted is thrown, or InputError for a cell whose scene has faults. The values do not depend
// on the number of threads, nor on what was there.
void compute_blocks(const MapJob& job, const std::vector<int>& wanted,
                    const std::filesystem::path& work, const ComputeOptions& options,
                    TileFile& file);

}  // namespace twinarm
