// Where in the picture shadows can fall on the floor. Looking up a shadow is the dearest part of a
// pixel, and a shader runs both sides of its branches, so it is left out of whole rectangles.
//
// Each box that casts is enlarged by `margin`, its corners are moved along the light to the plane
// z = floor_height and on into the picture; what can be in its shadow lies in their convex hull,
// since all of these maps keep lines straight. Cost: corners^2 / 2 for each box and row of tiles.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/spatial/pose.h"

namespace twinarm {

struct CasterBox {
  Pose X_WB;                       // its middle and its axes
  Vector3 half = Vector3::Zero();  // of its edges [m]
};

struct FloorLight {
  Vector3 towards_light_W = Vector3::UnitZ();  // unit length
  double floor_height = 0;                     // [m]
  double margin = 0;                           // [m]
};

// A part of one row of tiles, in pixels from the lower left corner of the picture.
struct FloorTiles {
  int x = 0, y = 0, width = 0, height = 0;
  bool maybe_shadowed = false;
};

// Together they fill the picture, each pixel once.
std::vector<FloorTiles> floor_tiles(const std::vector<CasterBox>& casters, const FloorLight& light,
                                    const Eigen::Matrix4d& clip_from_world, int width, int height);

}  // namespace twinarm
