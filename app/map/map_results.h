// Results of a map job: cells, predicted limits, output, one cell.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/map/map_job.h"
#include "app/map/tile_file.h"

namespace twinarm {

// Adds the missing cells of the blocks `wanted` to the file, and writes it to `work` about every
// second and at the end, also if Interrupted or InputError is thrown. The values do not depend on
// the number of threads (0: one per processor), nor on existing cells.
void compute_blocks(const MapJob& job, const std::vector<int>& wanted,
                    const std::filesystem::path& work, unsigned threads, TileFile& file);

struct MapCurve {
  std::string name;
  std::vector<double> x, y;  // values of the axes; NaN separates branches
};

// Predicted stability limits as curves in the plane of the map
// (docs/understand/stability_of_spring_dampers.md).
//
// Linearised about a pose, with e = q_K - q_D, a step is stable if no eigenvalue of its matrix lies
// outside the unit circle. Poses: the start, and the worst of the target's motion. An implicit
// linear coupling has an explicit remainder, the rotation of its lever arm: its geometric limit is
// max_target_radius() (coupling/analysis/prediction.h) for each joint between link and base.
//
// Empty for held forces, constraints, and integrators without a polynomial step. Found by bisection
// along columns, to 1e-4 of the axis.
std::vector<MapCurve> theory_curves(const MapJob& job);

std::string map_json(const MapJob& job, const TileFile& file, const std::vector<MapCurve>& curves);
std::string map_csv(const MapJob& job, const TileFile& file);
// Numbers of cells and of stable cells, range of the measure.
std::string map_words(const MapJob& job, const TileFile& file);

// Throw InputError without gnuplot.
std::string map_svg(const MapJob& job, const TileFile& file, const std::vector<MapCurve>& curves);
std::string map_png(const MapJob& job, const TileFile& file, const std::vector<MapCurve>& curves);

struct OpenedCell {
  double x = 0, y = 0;
  CellValues values{};
  std::filesystem::path scene;  // the scene with both parameters set
  std::string command;          // `twinarm simulate` of the same run
};

// "IX,IY"; throws InputError for a cell outside the map.
std::pair<int, int> parse_cell(const std::string& text, const MapJob& job);

// Runs the cell; writes the recording, and the scene with the same name and .toml. Throws
// InputError.
OpenedCell open_cell(const MapJob& job, int ix, int iy, const std::filesystem::path& recording);

}  // namespace twinarm
