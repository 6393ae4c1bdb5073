// Meshes and colours of all shapes of a scene or a robot, fixed to their bodies. Made once; the
// poses of the bodies come with each snapshot.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/render/list/draw_list.h"
#include "app/render/list/visual_model.h"
#include "app/scene/model/scene_model.h"

namespace twinarm {

// Meshes for the shapes of scenes and robots, in the shape's frame G.

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

struct ScenePart {
  std::size_t body = 0;  // of the model; 0: the world
  int robot = -1;        // index; -1: a body of the scene
  MeshId mesh = 0;
  Pose X_LM;  // of the mesh in the link's frame
  Vector3 scale = Vector3::Ones();
  Color color;
  std::optional<TextureId> texture;
  Eigen::AlignedBox3d box_M{Vector3(Vector3::Zero())};  // bounds, scaled, in M [m]
};

// Solid where normal . x <= offset; drawn as a plate or as the ground.
struct ScenePlane {
  std::size_t body = 0;
  Vector3 normal_L = Vector3::UnitZ();
  double offset = 0;
  Color color;
};

struct TieLine {  // a string, rod or spring between two points
  std::size_t a = 0, b = 0;
  Vector3 p_La = Vector3::Zero(), p_Lb = Vector3::Zero();
  bool is_spring = false;
};

struct SceneMeshes {
  std::vector<ScenePart> parts;
  std::vector<ScenePlane> planes;
  std::vector<TieLine> ties;
  std::vector<std::string> notes;  // replaced or omitted parts, for the user
};

// A link without a readable visual is drawn by its collision shapes, with a note. Throws InputError
// if the mesh of a body cannot be read.
SceneMeshes make_scene_meshes(const SceneModel& scene, DrawList& list);
SceneMeshes make_scene_meshes(const RobotDescription& robot, const Model<double>& model,
                              DrawList& list);

}  // namespace twinarm
