// What a scene's shapes are to the rooms that compute with them.
#pragma once

#include "app/scene/read/scene_description.h"
#include "collision/shapes/shape.h"

namespace twinarm {

// Of the uniform solid, in the shape's frame. Throws InputError for a mesh that cannot be read, and
// std::invalid_argument for a shape that has no inside (half-space, hollow).
MassProperties solid_properties(const ShapeDescription& shape, double density);

// Throws InputError for a mesh that cannot be read or spans no volume, and for a shape that
// contacts do not know.
Shape collision_shape(const ShapeDescription& shape);

}  // namespace twinarm
