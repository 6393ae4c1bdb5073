// What comes out of a map: JSON, CSV, a picture, words.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/map/map_curves.h"
#include "app/map/map_job.h"
#include "app/map/tile_file.h"

namespace twinarm {

// One measure of a whole map, [iy * nx + ix].
std::vector<double> values_of(const MapJob& job, const TileFile& file, MapMeasure measure);

std::string map_json(const MapJob& job, const TileFile& file, const std::vector<MapCurve>& curves);
std::string map_csv(const MapJob& job, const TileFile& file);
// How many cells, how many of them stable, the range of the measure.
std::string map_words(const MapJob& job, const TileFile& file);

// Throws InputError where there is no gnuplot.
std::string map_svg(const MapJob& job, const TileFile& file, const std::vector<MapCurve>& curves);
std::string map_png(const MapJob& job, const TileFile& file, const std::vector<MapCurve>& curves);

}  // namespace twinarm
