// What a map is of: a scene, two of its numbers, a measure. The same job gives the same bytes.
#pragma once

#include <string>
#include <vector>

#include "app/data/value.h"
#include "app/map/cell_measure.h"
#include "app/map/map_axis.h"
#include "app/map/map_options.h"
#include "app/run/simulate_input.h"

namespace twinarm {

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
void put_in(const MapJob& job, double x, double y, Value& scene, FaultList& faults);
// Ready to run. Throws InputError, which tells what an axis brought in by that axis.
SimulatePlan prepare_cell(const MapJob& job, double x, double y);

}  // namespace twinarm
