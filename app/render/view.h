// Where things land: bounds of a scene, and the matrices from the world to clip space.
//
// World frame: z up, metres. Clip space is OpenGL's: x right, y up, -w <= x, y, z <= w. Computed in
// double and handed to the graphics side in single precision.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "app/render/draw_list.h"

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
// shadows have faded at the rim.
double floor_radius(const Camera& camera, const SceneBounds& bounds);

Eigen::Matrix4d make_clip_from_world(const Camera& camera, double aspect,
                                     const SceneBounds& bounds);

// Parallel light from the given direction; the ball just fits into clip space.
Eigen::Matrix4d make_light_clip_from_world(const Vector3& towards_light_W, const Ball& ball);

// Pixel of a world point, from the top left corner; nothing where it is behind the camera.
std::optional<Eigen::Vector2d> project(const Eigen::Matrix4d& clip_from_world, const Vector3& p_W,
                                       int width, int height);

}  // namespace twinarm
