// The draw lists of a film, packed: layer by layer, each in columns over all frames, as
// src/protocol/run.ts has them. The lists are those of the painter of pictures; nothing is drawn
// anew.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "app/data/json_writer.h"
#include "app/draw/overlays/overlays.h"
#include "app/draw/scene_view.h"
#include "app/page/channels.h"

namespace twinarm {

// Entries of a draw list in columns, as every page has them: packed over a film's frames
// (page_layers.h), or of one frame of a run that goes on (app/lab/stream).

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
  // Each column with its name in pages.
  template <class Columns, class Visit>
  static void each(Columns& all, const Visit& visit) {
    visit("mesh", all.mesh);
    visit("flags", all.flags);
    visit("shininess", all.shininess);
    visit("color", all.color);
    visit("texture", all.texture);
    visit("position", all.position);
    visit("turn", all.turn);
    visit("scale", all.scale);
  }
};

// Those that stand at a point of the world; texts are kept by whoever knows how.
struct LabelColumns {
  std::vector<float> position;       // 3 [m]
  std::vector<std::int16_t> offset;  // 2: pixels to the right and down
  // False, and nothing is added, for a line on the screen or at no finite place.
  bool add(const Label& label);
};

// Behind what is there, from the next multiple of 8 bytes on, so that a browser can look at arrays
// in place: where that is. Little-endian, as the machine (solver/support/state_archive.h asserts
// it).
std::size_t append_array(std::string& bytes, const void* data, std::size_t size);

// Layer 0, the bodies, and one for each overlay.
struct LayerWords {
  std::string name, what;
};
std::vector<LayerWords> layer_words(const std::vector<const std::vector<Overlay>*>& overlays);

// Textures beyond that number are not sent: places in columns are bytes.
inline constexpr std::size_t kMaxTextures = 255;
// PNG; a wide one is halved until it is at most 1024 pixels.
std::string texture_file(const Image& image);

// A list of lines; three numbers of 0 to 255.
void write_legend(JsonWriter& json, const std::vector<LegendLine>& legend);
void write_color(JsonWriter& json, const char* key, const Color& color);
// Key view: camera, light, floor.
void write_view(JsonWriter& json, const SceneView& stage);

struct PageLayer {
  std::string name, what;
  bool shown = false;  // at first
  std::vector<LegendLine> legend;
  // Frame f has the entries first[f] to first[f + 1].
  std::vector<std::uint32_t> first{0}, first_label{0};
  InstanceColumns instances;
  LabelColumns labels;
  std::vector<std::uint32_t> text;  // of labels: numbers
};

class PageLayers {
 public:
  explicit PageLayers(SceneView& stage);
  void add_frame(const Snapshot& moment);
  // Layers "body/NAME" with what belongs to that body alone; of the one frame of a page.
  void add_apart(const Snapshot& moment);
  void show_at_first(const std::vector<std::string>& names);
  // Keys meshes, textures, layers, texts.
  void write(JsonWriter& json, PageBytes& bytes) const;

 private:
  // Of the list: from there to there.
  void add_entries(PageLayer& layer, const Drawn& from, const Drawn& to);
  Drawn end_of_list() const;
  std::uint32_t number_of(const std::string& text);

  SceneView& stage_;
  std::vector<PageLayer> layers_;   // the bodies, then the overlays
  std::vector<std::string> texts_;  // of labels, each once
  std::map<std::string, std::uint32_t> numbers_;
};

}  // namespace twinarm
