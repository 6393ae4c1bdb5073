// A model without fixed joints: what is fixed to a link is one body with it.
#pragma once

#include <vector>

#include "solver/model/model.h"
#include "solver/spatial/pose.h"

namespace twinarm {

struct LumpedModel {
  Model<double> model;               // same coordinates, velocities and joints' properties
  std::vector<std::size_t> origin;   // by lumped body: the body of the whole model
  std::vector<std::size_t> carrier;  // by body: the lumped body that it is part of; 0 of the base
  std::vector<Transform<double>> X;  // by body: from its carrier's axes and origin to its own
  std::vector<Inertia<double>> I;  // by body: its own inertia, about and in the axes of its carrier

  // All joints with a degree of freedom have one.
  explicit LumpedModel(const Model<double>& whole);
  // A point of one of the bodies, from its origin in link axes: from the carrier's in body axes.
  Vec3<double> point_of(const Model<double>& whole, std::size_t body, const Vector3& p_L) const;
  // Of the lumped bodies, where each body's inertia has a factor; empty: 1 for all.
  std::vector<Inertia<double>> inertias(const std::vector<double>& factor) const;
};

}  // namespace twinarm
