// Scenes offered by the lab: assets/scenes/gallery/gallery.toml, with pictures in the same folder
// and scenes in the parent folder.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "app/lab/run/variants.h"

namespace twinarm {

struct GalleryScene {
  std::string name, title;
  std::filesystem::path file;       // absolute
  std::filesystem::path picture;    // absolute; empty: none
  std::array<std::string, 3> look;  // what to look for
  VariantSet variants;              // initial; empty: one run
};

// Throws InputError with all faults.
std::vector<GalleryScene> read_gallery(const std::filesystem::path& file);
// Of the assets; `twinarm lab` opens the first one by default.
std::vector<GalleryScene> read_gallery();

// The paper's four experiments: a scene of the gallery and changes to it.
struct Preset {
  std::string name, what;            // "E3", one line
  std::string scene;                 // file below assets/scenes/
  std::vector<std::string> changes;  // PATH=VALUE; may be empty
  std::string hand = "scene";        // input source: "scene" or "drag"
};

const std::vector<Preset>& all_presets();

}  // namespace twinarm
