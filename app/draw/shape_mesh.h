// What the shapes of scenes and robots look like: a mesh of a DrawList and its scale, in the
// shape's frame G.
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
  Pose X_GM;                              // the mesh's own frame M in that of the shape
  Vector3 scale = Vector3::Ones();        // of the mesh, in M
  bool is_hollow = false;                 // one looks into it: to be drawn translucent
  std::optional<Color> color = {};        // where a file of meshes states one
  std::optional<TextureId> texture = {};  // likewise
  bool can_be_textured = false;  // the mesh knows where each of its corners lies in a picture
};

// Nothing for a half-space, which has no extent of its own. A mesh of a scene is drawn as contacts
// have it: its convex hull, unless it says otherwise. Throws InputError for a mesh that cannot be
// read.
std::optional<ShapeLook> look_of(const ShapeDescription& shape, DrawList& list);
// A collision shape or a visual of a robot's file. Of a mesh, all parts with their own colours and
// textures; what was mended or left out of it is noted.
std::vector<ShapeLook> looks_of(const ShapeDescription& geometry, DrawList& list, KeepPlaces keep,
                                std::vector<std::string>& notes);

}  // namespace twinarm
