// A model without fixed joints: links fixed to each other are merged into one body.
#pragma once

#include <vector>

#include "coupling/batch/batch_run.h"
#include "solver/model/model.h"
#include "solver/spatial/pose.h"

namespace twinarm {

struct ModelWithoutFixedJoints {
  Model<double> model;               // same coordinates, velocities and joints' properties
  std::vector<std::size_t> carrier;  // by body: its merged body; 0: base
  std::vector<Transform<double>> X;  // by body: from its carrier's frame to its own

  // Joints have at most one degree of freedom.
  explicit ModelWithoutFixedJoints(const Model<double>& whole);
  // From link coordinates of a body's point to coordinates of its carrier.
  Vec3<double> point_of(const Model<double>& whole, std::size_t body, const Vector3& p_L) const;
};

}  // namespace twinarm
