// Meshes and colours of all shapes of a scene or a robot, fixed to their bodies. Made once; the
// poses of the bodies come with each snapshot.
#pragma once

#include <string>
#include <vector>

#include "app/render/list/draw_list.h"
#include "app/scene/model/scene_model.h"

namespace twinarm {

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

struct DistanceConstraintLine {  // a string or rod between two points
  std::size_t a = 0, b = 0;
  Vector3 p_La = Vector3::Zero(), p_Lb = Vector3::Zero();
};

struct SceneMeshes {
  std::vector<ScenePart> parts;
  std::vector<ScenePlane> planes;
  std::vector<DistanceConstraintLine> ties;
  std::vector<std::string> notes;  // replaced or omitted parts, for the user
};

// A link without a readable visual is drawn by its collision shapes, with a note. Throws InputError
// if the mesh of a body cannot be read.
SceneMeshes make_scene_meshes(const SceneModel& scene, DrawList& list);
SceneMeshes make_scene_meshes(const RobotDescription& robot, const Model<double>& model,
                              DrawList& list);

}  // namespace twinarm
