// Meshes for the shapes of scenes and robots, in the shape's frame G.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/render/list/draw_list.h"
#include "app/render/list/visual_model.h"
#include "app/scene/read/scene_description.h"

namespace twinarm {

struct ShapeLook {
  MeshId mesh = 0;
  Pose X_GM;                              // frame M of the mesh in that of the shape
  Vector3 scale = Vector3::Ones();        // of the mesh, in M
  bool is_hollow = false;                 // a cavity: drawn translucent
  std::optional<Color> color = {};        // from the mesh file
  std::optional<TextureId> texture = {};  // from the mesh file
  bool can_be_textured = false;           // the mesh has texture coordinates
};

// Empty for a half-space. A mesh of a scene is drawn as in contact: by its convex hull, unless
// `convex` is false. Throws InputError if a mesh cannot be read.
std::optional<ShapeLook> look_of(const ShapeDescription& shape, DrawList& list);
// A collision shape or visual of a robot's file; of a mesh all parts with their colours and
// textures. Repairs and omissions are noted.
std::vector<ShapeLook> looks_of(const ShapeDescription& geometry, DrawList& list, KeepPlaces keep,
                                std::vector<std::string>& notes);

}  // namespace twinarm
