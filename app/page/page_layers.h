// Draw lists of a film for a page: by layer, each in columns over all frames
// (app/web/src/protocol/run.ts).
#pragma once

#include "app/draw/overlays/overlays.h"
#include "app/page/channels.h"

namespace twinarm {

// Columns over instances; numbers per instance in comments.
struct InstanceColumns {
  std::vector<std::uint16_t> mesh;
  std::vector<std::uint8_t> flags;  // 1: visible through bodies
  std::vector<std::uint8_t> shininess;
  std::vector<std::uint8_t> color;    // 4: red, green, blue, alpha
  std::vector<std::uint8_t> texture;  // 0: none, else one more than its number
  std::vector<float> position;        // 3 [m]
  std::vector<std::int16_t> turn;     // 4: quaternion x, y, z, w in units of 1/32767
  std::vector<float> scale;           // 3
  void add(const Instance& instance);
  // Visits each column with its name in pages.
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

// Labels at points of the world; their texts are stored elsewhere.
struct LabelColumns {
  std::vector<float> position;       // 3 [m]
  std::vector<std::int16_t> offset;  // 2: pixels to the right and down
  // False, without effect, for a screen label or a point that is not finite.
  bool add(const Label& label);
};

// Appends at the next multiple of 8 bytes, for typed arrays in the browser; returns the offset.
// Little-endian like the machine (asserted in solver/support/state_archive.h).
std::size_t append_array(std::string& bytes, const void* data, std::size_t size);

// Names of the layers: the bodies, then one for each overlay.
struct LayerWords {
  std::string name, what;
};
std::vector<LayerWords> layer_words(const std::vector<const std::vector<Overlay>*>& overlays);

// Further textures are not sent: indices are bytes.
inline constexpr std::size_t kMaxTextures = 255;
// PNG; a wide one is halved until it is at most 1024 pixels.
std::string texture_file(const Image& image);

void write_legend(JsonWriter& json, const std::vector<LegendLine>& legend);
void write_color(JsonWriter& json, const Color& color);
// Key view: camera, light, floor.
void write_view(JsonWriter& json, const SceneView& view);

struct PageLayer : LayerWords {
  bool shown = false;  // initially
  std::vector<LegendLine> legend;
  // Frame f has the entries first[f] to first[f + 1].
  std::vector<std::uint32_t> first{0}, first_label{0};
  InstanceColumns instances;
  LabelColumns labels;
  std::vector<std::uint32_t> text;  // of labels: index of the text
};

class PageLayers {
 public:
  explicit PageLayers(SceneView& view);
  void add_frame(const Snapshot& snapshot);
  // Layers "body/NAME" with the parts of one body; for a page with one frame.
  void add_apart(const Snapshot& snapshot);
  void show_at_first(const std::vector<std::string>& names);
  // Keys meshes, textures, layers, texts.
  void write(JsonWriter& json, PageBytes& bytes) const;

 private:
  // Entries of the list in [from, to).
  void add_entries(PageLayer& layer, const Drawn& from, const Drawn& to);
  std::uint32_t number_of(const std::string& text);

  SceneView& view_;
  std::vector<PageLayer> layers_;   // the bodies, then the overlays
  std::vector<std::string> texts_;  // of labels, unique
  std::map<std::string, std::uint32_t> numbers_;
};

}  // namespace twinarm
