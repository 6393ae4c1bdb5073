// The direction of least overlap where one of two bodies is a cylinder.
#pragma once

#include <vector>

#include "collision/clip.h"
#include "collision/round_contact.h"
#include "collision/solid.h"

namespace twinarm {

class CylinderAxis {
 public:
  // False if it is certain that the bodies are more than `margin` apart.
  bool nearest(const Placed& a, const Placed& b, double margin, NearestPair& pair);

 private:
  void overlapping(const Placed& a, const Placed& b, CoreDistance& cores, Axis& best);
  void add_start(const Placed& a, const Placed& b, const Vector3& n_W);
  void add_deep_starts(const Placed& a, const Placed& b);
  void refine_starts(const Placed& a, const Placed& b, int count, Axis& best);
  void consider_faces(const Placed& a, const Placed& b, Axis& best);
  void refine(const Placed& a, const Placed& b, Axis& best);

  Feature feature_;
  std::vector<Vector3> ridges_W_;
  std::vector<Axis> starts_;
};

}  // namespace twinarm
