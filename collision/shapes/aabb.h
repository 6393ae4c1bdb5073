// An axis-aligned bounding box.
#pragma once

#include "solver/spatial/pose.h"

namespace twinarm {

struct Aabb {  // in W [m]
  Vector3 low, high;
};

}  // namespace twinarm
