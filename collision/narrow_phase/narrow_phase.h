// Two solids -> the normal, the depth and the contact points.
#pragma once

#include <vector>

#include "collision/narrow_phase/clip.h"
#include "collision/narrow_phase/closed_forms.h"
#include "collision/narrow_phase/curved_axis.h"
#include "collision/narrow_phase/gjk.h"
#include "collision/narrow_phase/manifold.h"
#include "collision/narrow_phase/separating_axis.h"

namespace twinarm {

// Two surfaces without a body behind them (half-spaces, hollows) have no contacts that could be
// listed, nor have two meshes; all other pairs have. Meshes against convex bodies: mesh_contact.h.
bool is_supported(const Shape& a, const Shape& b);

class NarrowPhase {
 public:
  // The normal from A to B (zero where each point has its own), and the contacts with depth >
  // -margin. Empty if there are none.
  struct Result {
    Vector3 n_W = Vector3::Zero();
    const std::vector<ManifoldPoint>* points = nullptr;  // valid until the next call
    bool empty() const { return points == nullptr || points->empty(); }
  };
  Result contacts(const PosedShape& a, const PosedShape& b, double margin);

  // Signed distance: how far the surfaces are apart, or minus the least overlap [m].
  double distance(const PosedShape& a, const PosedShape& b);

  // Direction and amount of the least overlap; false if it is certain that they are more than
  // `margin` apart.
  bool nearest(const PosedShape& a, const PosedShape& b, double margin, NearestPair& pair);

 private:
  FlatAxis flat_axis_;
  SeparatingAxis separating_axis_;
  CurvedAxis curved_;
  Manifold manifold_;
  std::vector<ManifoldPoint> points_;
};

}  // namespace twinarm
