// The draw lists of a film, packed: layer by layer, each in columns over all frames, as
// src/protocol/run.ts has them. The lists are those of the painter of pictures; nothing is drawn
// anew.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "app/draw/overlays/overlays.h"
#include "app/page/draw_columns.h"
#include "app/page/page_bytes.h"

namespace twinarm {

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
  explicit PageLayers(Stage& stage);
  void add_frame(const Moment& moment);
  // Layers "body/NAME" with what belongs to that body alone; of the one frame of a page.
  void add_apart(const Moment& moment);
  void show_at_first(const std::vector<std::string>& names);
  // Keys meshes, textures, layers, texts.
  void write(JsonWriter& json, PageBytes& bytes) const;

 private:
  // Of the list: from there to there.
  void add_entries(PageLayer& layer, const Drawn& from, const Drawn& to);
  Drawn end_of_list() const;
  std::uint32_t number_of(const std::string& text);

  Stage& stage_;
  std::vector<PageLayer> layers_;   // the bodies, then the overlays
  std::vector<std::string> texts_;  // of labels, each once
  std::map<std::string, std::uint32_t> numbers_;
};

}  // namespace twinarm
