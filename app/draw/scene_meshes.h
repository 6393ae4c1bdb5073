// The cast: all that has a shape, with its mesh, colour and the body that carries it. Made once for
// a scene or a robot; where the bodies stand comes with each moment.
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
  Vector3 low_M = Vector3::Zero(), high_M = Vector3::Zero();  // bounds, scaled, in M [m]
};

// Solid where normal . x <= offset; drawn as a plate as large as the scene, or as the ground.
struct ScenePlane {
  std::size_t body = 0;
  Vector3 normal_L = Vector3::UnitZ();
  double offset = 0;
  Color color;
};

struct DistanceConstraintLine {  // of a distance constraint: a string or a rod between two points
  std::size_t a = 0, b = 0;
  Vector3 p_La = Vector3::Zero(), p_Lb = Vector3::Zero();
};

struct SceneMeshes {
  std::vector<ScenePart> parts;
  std::vector<ScenePlane> planes;
  std::vector<DistanceConstraintLine> ties;
  std::vector<std::string> notes;  // what stands in for something else, for the user to know
};

// A link without a visual, or whose mesh cannot be read, is drawn by its collision shapes, and that
// is noted. Throws InputError where a mesh of a body cannot be read.
SceneMeshes cast_of(const SceneModel& scene, DrawList& list);
SceneMeshes cast_of(const RobotDescription& robot, const Model<double>& model, DrawList& list);

}  // namespace twinarm
