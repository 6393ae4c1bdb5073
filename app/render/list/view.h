// Where things land: bounds of a scene, and the matrices from the world to clip space.
//
// World frame: z up, metres. Clip space is OpenGL's: x right, y up, -w <= x, y, z <= w. Computed in
// double and handed to the graphics side in single precision.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "app/render/list/draw_list.h"

namespace twinarm {

struct Ball {
  Vector3 center = Vector3::Zero();  // in W [m]
  double radius = 1;
};

// What is to be fitted into shadow maps and the depth range. `solid` bounds what casts shadows,
// `all` ghosts too. Instances more than 30 viewing distances away are ignored: one body that a
// diverged simulation has thrown away must not cost all others their shadows.
struct SceneBounds {
  Ball solid, all;
};
SceneBounds bound_scene(const DrawList& list);

// The floor is drawn in this disc about the point that the camera looks at; its grid and its
// shadows have faded at the rim, and a landscape's ground is lost in haze.
double floor_radius(const DrawList& list, const SceneBounds& bounds);

Eigen::Matrix4d make_clip_from_world(const Camera& camera, double aspect, const SceneBounds& bounds,
                                     double floor_radius);

// How many of the picture's rows, from below, are filled by this square of the floor from end to
// end, where nothing stands before it.
struct FloorSquare {
  Vector3 center;     // in W; its z does not count
  double height = 0;  // [m]
  double half_side = 1;
};
int rows_all_floor(const Eigen::Matrix4d& clip_from_world, const FloorSquare& floor,
                   int picture_height);

// Parallel light from the given direction; the ball just fits into clip space.
Eigen::Matrix4d make_light_clip_from_world(const Vector3& towards_light_W, const Ball& ball);

// How many texels across a shadow map makes them as large as the pixels at the camera's target.
double shadow_texels(const Camera& camera, const SceneBounds& bounds, int picture_height);

// Pixel of a world point, from the top left corner; nothing where it is behind the camera.
std::optional<Eigen::Vector2d> project(const Eigen::Matrix4d& clip_from_world, const Vector3& p_W,
                                       int width, int height);

}  // namespace twinarm
