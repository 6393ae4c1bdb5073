// What a map is of: a scene, two of its numbers, a measure. The same job gives the same bytes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/data/value.h"
#include "app/map/cell_measure.h"
#include "app/run/simulate_input.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// Options of `twinarm map`.
struct MapOptions {
  std::filesystem::path scene;
  std::string x, y;                      // PATH:FROM:TO:N[:log]
  std::string measure = "stable", of;    // `of`: a coupling's name; empty: the first
  std::optional<double> duration, step;  // [s]; left out: as the scene says
  std::string integrator;
  std::filesystem::path svg, png, csv;  // empty: none
  std::filesystem::path work;           // where finished cells are kept; empty: below out/map
  int tiles = 0, tile = -1;             // one part of many
  std::vector<std::filesystem::path> merge;
  std::string cell;              // "IX,IY", opened
  std::filesystem::path record;  // its recording
  unsigned threads = 0;          // 0: all processors
  bool alone = false;            // each cell by itself, as `simulate` runs it
  bool force = false, json = false;
};

// One axis of a map: a number of the scene, and the values that it takes.
struct MapAxis {
  std::string path;  // of the number in the scene file (app/scene/read/change_scene.h)
  double from = 0, to = 0;
  int count = 0;  // cells, both ends included
  bool log = false;

  // At a cell, or between two of them: u in [0, count - 1]. The ends are `from` and `to` to the
  // bit.
  double at(double u) const;
  // Where a value lies between the cells.
  double place_of(double value) const;
  std::string text() const;  // PATH:FROM:TO:N[:log], each number in the fewest digits
};

// PATH:FROM:TO:N[:log]; adds all its faults, which name the option, and returns nothing then.
std::optional<MapAxis> parse_axis(const std::string& option, const std::string& text,
                                  DiagnosticList& faults);

// What lines of MapJob::identity say besides names and numbers. They are part of the form of tile
// files, of which older ones must fit: no word of them changes.
namespace identity {
inline constexpr const char* kAsScene = "as the scene says";
inline constexpr const char* kFirstCoupling = "the first coupling";
inline constexpr const char* kSideBySide = "side by side";
inline constexpr const char* kOneByOne = "one by one";
}  // namespace identity

struct MapJob {
  MapAxis x, y;
  MapMeasure measure = MapMeasure::stable;
  std::size_t measured_coupling = 0;  // whose twin errors refer to
  SimulateOptions run;                // of the scene as it stands in its file
  Value scene;
  std::string x_unit, y_unit, unit, error_unit;  // `unit` is the measure's
  bool side_by_side = false;  // cells share the lanes of the processor (app/map/cell_batch.h)
  // By lines, what must be the same in files that belong together (app/map/tile_file.h). All
  // measures are computed at once: which one is shown is not among them.
  std::vector<std::string> identity;

  int nx() const { return x.count; }
  int ny() const { return y.count; }
};

// Reads the scene, and runs nothing. Throws InputError with all faults: of the options, the axes,
// and of the scene at the corners of the map.
MapJob read_map_job(const MapOptions& options);

// The scene with the two numbers put in; u as in MapAxis::at().
void put_in(const MapJob& job, double x, double y, Value& scene, DiagnosticList& faults);
// Ready to run. Throws InputError, which tells what an axis brought in by that axis.
SimulatePlan prepare_cell(const MapJob& job, double x, double y);

}  // namespace twinarm
