// Entries of a draw list in columns, as every page has them: packed over a film's frames
// (page_layers.h), or of one frame of a run that goes on (app/lab/stream).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/data/json_writer.h"
#include "app/draw/scene_view.h"

namespace twinarm {

// One entry per instance, but for those that say more.
struct InstanceColumns {
  std::vector<std::uint16_t> mesh;
  std::vector<std::uint8_t> flags;  // 1: seen through
  std::vector<std::uint8_t> shininess;
  std::vector<std::uint8_t> color;    // 4: red, green, blue, alpha
  std::vector<std::uint8_t> texture;  // 0: none, else one more than its number
  std::vector<float> position;        // 3 [m]
  std::vector<std::int16_t> turn;     // 4: quaternion x, y, z, w in units of 1/32767
  std::vector<float> scale;           // 3
  void add(const Instance& instance);
};

// Those that stand at a point of the world; texts are kept by whoever knows how.
struct LabelColumns {
  std::vector<float> position;       // 3 [m]
  std::vector<std::int16_t> offset;  // 2: pixels to the right and down
  // False, and nothing is added, for a line on the screen or at no finite place.
  bool add(const Label& label);
};

// Textures beyond that number are not sent: places in columns are bytes.
inline constexpr std::size_t kMostTextures = 255;
// PNG; a wide one is halved until it is at most 1024 pixels.
std::string texture_file(const Image& image);

// A list of lines; three numbers of 0 to 255.
void write_legend(JsonWriter& json, const std::vector<LegendLine>& legend);
void write_color(JsonWriter& json, const char* key, const Color& color);
// Key view: camera, light, floor.
void write_view(JsonWriter& json, const Stage& stage);

}  // namespace twinarm
