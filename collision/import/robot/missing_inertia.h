// Inertia for links whose file gives none: real robot files often leave it out, or give it to some
// links only. MuJoCo's inertiafromgeom and boundmass are the models.
#pragma once

#include <optional>

#include "collision/import/robot/robot_description.h"

namespace twinarm {

struct MissingInertia {
  // [kg/m^3]: a link without mass or inertia gets that of its collision shapes, or else of its
  // visual ones, each a solid; a mesh counts as its convex hull. If it has a mass, scaled to that.
  std::optional<double> density;
  // [kg]: a link that still has no mass or inertia gets that of a ball of the density of water, of
  // this mass or of its own if that is larger.
  std::optional<double> min_mass;
  bool any() const { return density || min_mass; }
};

// Throws InputError for values that are not positive, and for shapes without a volume.
void add_missing_inertia(RobotDescription& robot, const MissingInertia& missing);

}  // namespace twinarm
