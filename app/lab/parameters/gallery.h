// The scenes that the lab offers: assets/scenes/gallery/gallery.toml, with its pictures beside
// it; the scenes lie in the folder above.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "app/data/json_writer.h"
#include "app/lab/run/variant_set.h"

namespace twinarm {

struct GalleryScene {
  std::string name, title;
  std::filesystem::path file;       // absolute
  std::filesystem::path picture;    // absolute; empty: there is none
  std::array<std::string, 3> look;  // what to look for
  LaneSet lanes;                    // that it is opened with; empty: one run
};

// Throws InputError with all faults: a file that is not there, less than three lines.
std::vector<GalleryScene> read_gallery(const std::filesystem::path& file);
// Of the assets; the first is what `twinarm lab` opens where it is told nothing.
std::vector<GalleryScene> read_gallery();
// nullptr where there is none of that name.
const GalleryScene* find_scene(const std::vector<GalleryScene>& gallery, const std::string& name);

// The list `gallery` of docs/lab_protocol.md.
void write_gallery(const std::vector<GalleryScene>& gallery, JsonWriter& json);

}  // namespace twinarm
