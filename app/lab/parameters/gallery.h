// The scenes that the lab offers: assets/scenes/gallery/gallery.toml, with its pictures beside
// it; the scenes lie in the folder above.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "app/data/json_writer.h"
#include "app/lab/run/variants.h"

namespace twinarm {

struct GalleryScene {
  std::string name, title;
  std::filesystem::path file;       // absolute
  std::filesystem::path picture;    // absolute; empty: there is none
  std::array<std::string, 3> look;  // what to look for
  VariantSet lanes;                 // that it is opened with; empty: one run
};

// Throws InputError with all faults: a file that is not there, less than three lines.
std::vector<GalleryScene> read_gallery(const std::filesystem::path& file);
// Of the assets; the first is what `twinarm lab` opens where it is told nothing.
std::vector<GalleryScene> read_gallery();
// nullptr where there is none of that name.
const GalleryScene* find_scene(const std::vector<GalleryScene>& gallery, const std::string& name);

// The list `gallery` of docs/reference/lab_protocol.md.
void write_gallery(const std::vector<GalleryScene>& gallery, JsonWriter& json);

// The paper's four experiments, one click each: a scene of the gallery and what is changed in it.
struct Preset {
  std::string name, what;            // "E3", one line
  std::string scene;                 // file below assets/scenes/
  std::vector<std::string> changes;  // PATH=VALUE, after the scene is opened; may be empty
  // Who moves the robot then: "scene" (the motion in the file), or "drag" (the hand on the page).
  std::string hand = "scene";
};

const std::vector<Preset>& all_presets();
const Preset* find_preset(const std::string& name);  // nullptr where there is none

// The list `presets` of docs/reference/lab_protocol.md.
void write_presets(JsonWriter& json);

}  // namespace twinarm
