// Narrow phase: normal, depth and contact points of two shapes.
#pragma once

#include <vector>

#include "collision/narrow_phase/clip.h"
#include "collision/narrow_phase/closed_forms.h"
#include "collision/narrow_phase/curved_axis.h"
#include "collision/narrow_phase/gjk.h"
#include "collision/narrow_phase/manifold.h"
#include "collision/narrow_phase/separating_axis.h"

namespace twinarm {

// All pairs except two of half-space, cavity and mesh. Meshes against convex bodies:
// mesh_contact.h.
bool is_supported(const Shape& a, const Shape& b);

class NarrowPhase {
 public:
  // Normal from A to B (zero if each point has its own), and contacts with depth > -margin.
  struct Result {
    Vector3 n_W = Vector3::Zero();
    const std::vector<ManifoldPoint>* points = nullptr;  // valid until the next call
    bool empty() const { return points == nullptr || points->empty(); }
  };
  Result contacts(const PosedShape& a, const PosedShape& b, double margin);
  // The same along a known direction.
  Result contacts(const PosedShape& a, const PosedShape& b, const NearestPair& pair,
                  double margin) {
    return {pair.axis.n_W, &manifold_.between(a, b, pair.axis, pair.p_W, margin)};
  }

  // Signed distance; negative: penetration depth [m].
  double distance(const PosedShape& a, const PosedShape& b);

  // Minimum overlap and its direction; false if the bodies are more than `margin` apart.
  bool nearest(const PosedShape& a, const PosedShape& b, double margin, NearestPair& pair);

 private:
  FaceAxis face_axis_;
  SeparatingAxis separating_axis_;
  CurvedAxis curved_;
  Manifold manifold_;
  std::vector<ManifoldPoint> points_;
};

}  // namespace twinarm
