// A parameter map: a scene, two of its parameters, a measure. The same job gives the same bytes.
#pragma once

#include "app/map/cell_measure.h"

namespace twinarm {

struct MapOptions {
  std::filesystem::path scene;
  std::string x, y;                      // PATH:FROM:TO:N[:log]
  std::string measure = "stable", of;    // `of`: name of a coupling; empty: the first
  std::optional<double> duration, step;  // [s]; default: the scene's
  std::string integrator;
  std::filesystem::path svg, png, csv;  // empty: none
  std::filesystem::path checkpoint;     // checkpoint file; empty: in out/map
  int jobs = 0, job = -1;               // number of jobs, index of this one
  std::vector<std::filesystem::path> merge;
  std::string cell;              // "IX,IY"
  std::filesystem::path record;  // recording of that cell
  unsigned threads = 0;          // 0: all processors
  bool no_simd = false;          // no SIMD batches
  bool force = false, json = false;
};

// One axis of a map: a parameter of the scene and its values.
struct MapAxis {
  std::string path;  // of the parameter (app/scene/read/change_scene.h)
  double from = 0, to = 0;
  int count = 0;  // cells, both ends included
  bool log = false;

  double at(double u) const;            // u in [0, count - 1]; exact at both ends
  double place_of(double value) const;  // inverse of at()
  std::string text() const;             // PATH:MIN:MAX:N[:log] in the fewest digits
};

// Values of MapJob::identity. They are part of the file format: do not change them.
namespace identity {
inline constexpr const char* kAsScene = "as the scene says";
inline constexpr const char* kFirstCoupling = "the first coupling";
inline constexpr const char* kSideBySide = "side by side";
inline constexpr const char* kOneByOne = "one by one";
}  // namespace identity

struct MapJob {
  MapAxis x, y;
  MapMeasure measure = MapMeasure::stable;
  std::size_t measured_coupling = 0;  // index of the coupling whose tracking error is measured
  SimulateOptions run;                // of the scene file
  Value scene;
  std::string x_unit, y_unit, unit, error_unit;  // `unit` is the measure's
  bool side_by_side = false;                     // SIMD batches (app/map/cell_batch.h)
  // Lines that must agree in files of the same map (app/map/tile_file.cpp); not the measure, as all
  // of them are computed.
  std::vector<std::string> identity;

  int nx() const { return x.count; }
  int ny() const { return y.count; }
  std::size_t index(int ix, int iy) const {  // of a cell, row by row
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx()) +
           static_cast<std::size_t>(ix);
  }
};

// Reads the scene. Throws InputError with all diagnostics of options, axes, and of the scene at the
// corners of the map.
MapJob read_map_job(const MapOptions& options);

void set_parameters(const MapJob& job, double x, double y, Value& scene, DiagnosticList& faults);
// Throws InputError; diagnostics caused by a parameter name its axis.
SimulatePlan prepare_cell(const MapJob& job, double x, double y);

}  // namespace twinarm
