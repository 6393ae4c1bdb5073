// Results of a map job: cells, predicted limits, output, one cell.
#pragma once

#include "app/map/map_job.h"

namespace twinarm {

// Checkpoint file of a map: lines with its identity, then a CSV table of finished cells. Work file,
// tile of a job array and merged map have the same format. The bytes depend only on which cells are
// present.
//
//   # twinarm map 2
//   # KEY VALUE                                            any number
//   ix,iy,stable,max_error,mean_error,energy,passivity     kMapMeasures; empty: no value
//   0,0,1,0.5,..                                           row by row, y upward

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
// The measures at the end of a line, each after a comma; empty: no value.
std::string csv_fields(const CellValues& values);
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
