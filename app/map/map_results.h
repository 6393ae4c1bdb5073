// What is made of a map job: its cells, the limits of theory, what comes out, one cell opened.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/map/map_job.h"
#include "app/map/tile_file.h"

namespace twinarm {

// ---- all cells, on all cores ----

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

// ---- the limits of theory ----

struct MapCurve {
  std::string name;
  std::vector<double> x, y;  // values of the axes; a NaN parts two branches
};

// Stability limits of a map by linear theory, as curves in its plane
// (docs/understand/stability_of_spring_dampers.md).
//
// About a pose, with e = q_K - q_D, a step of the couplings is linear; it is stable where no
// eigenvalue of its matrix lies outside the unit circle. Two poses are taken: the start, and the
// worst of those that the twin passes. A point spring that is implicit keeps an explicit rest, the
// turning of its lever arm: the geometric limit of max_target_radius
// (coupling/analysis/prediction.h), for each joint between the link and the ground, between the
// radii at which link and target stand.
//
// Nothing where theory has no word: couplings that hold their force, constraints, integrators whose
// step is no polynomial. Found by bisection along columns, to 1e-4 of the axis' length.
std::vector<MapCurve> theory_curves(const MapJob& job);

// ---- what comes out: JSON, CSV, a picture, words ----

// One measure of a whole map, [iy * nx + ix].
std::vector<double> values_of(const MapJob& job, const TileFile& file, MapMeasure measure);

std::string map_json(const MapJob& job, const TileFile& file, const std::vector<MapCurve>& curves);
std::string map_csv(const MapJob& job, const TileFile& file);
// How many cells, how many of them stable, the range of the measure.
std::string map_words(const MapJob& job, const TileFile& file);

// Throws InputError where there is no gnuplot.
std::string map_svg(const MapJob& job, const TileFile& file, const std::vector<MapCurve>& curves);
std::string map_png(const MapJob& job, const TileFile& file, const std::vector<MapCurve>& curves);

// ---- one cell: its scene as a file of its own, its recording ----

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
