// Bounds of a scene, and matrices from the world to OpenGL's clip space (x right, y up,
// -w <= x, y, z <= w).
#pragma once

#include "app/render/list/draw_list.h"

namespace twinarm {

struct Ball {
  Vector3 center = Vector3::Zero();  // in W [m]
  double radius = 1;
};

// Bounds for shadow maps (`solid`) and depth range (`all`, with translucent bodies). Instances
// more than 30 viewing distances away, as in a diverged simulation, are ignored.
struct SceneBounds {
  Ball solid, all;
};
SceneBounds bound_scene(const DrawList& list);

// Radius of the floor about the camera's target; grid and shadows fade to its rim.
double floor_radius(const DrawList& list, const SceneBounds& bounds);

Eigen::Matrix4d make_clip_from_world(const Camera& camera, double aspect, const SceneBounds& bounds,
                                     double floor_radius);

// Number of picture rows, from below, that this square of the floor fills.
struct FloorSquare {
  Vector3 center;     // in W; z is ignored
  double height = 0;  // [m]
  double half_side = 1;
};
int rows_all_floor(const Eigen::Matrix4d& clip_from_world, const FloorSquare& floor,
                   int picture_height);

// Parallel light from the given direction; the ball fits into clip space.
Eigen::Matrix4d make_light_clip_from_world(const Vector3& towards_light_W, const Ball& ball);

// Side of a shadow map whose texels are as large as pixels at the camera's target [texels].
double shadow_texels(const Camera& camera, const SceneBounds& bounds, int picture_height);

// Pixel of a world point, from the top left corner; empty behind the camera.
std::optional<Eigen::Vector2d> project(const Eigen::Matrix4d& clip_from_world, const Vector3& p_W,
                                       int width, int height);

}  // namespace twinarm
