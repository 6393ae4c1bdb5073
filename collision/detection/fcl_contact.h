// Normals of pairs of convex shapes by FCL's narrow phase, a library that the program opens when it
// needs it (app/command/main/modules.cpp).
#pragma once

#include "collision/narrow_phase/closed_forms.h"
#include "collision/narrow_phase/gjk.h"
#include "collision/shapes/shape.h"

namespace twinarm {

class FclContact {
 public:
  enum class Answer {
    none,      // not for FCL: a half-space, a cavity or a mesh
    rejected,  // too deep for FCL, or its depth and overlap(n) of its normal differ
    apart,     // by more than the margin
    contact,
  };
  virtual ~FclContact() = default;
  // The shape of the next geometry.
  virtual void add(const Shape& shape) = 0;
  // Of geometries a and b (in the order of add()). `contact`: FCL's normal, and overlap(n) along
  // it, at least -margin.
  virtual Answer nearest(int a, int b, const PosedShape& at_a, const PosedShape& at_b,
                         double margin, NearestPair& pair) = 0;
};

}  // namespace twinarm

// The caller owns it.
extern "C" [[gnu::visibility("default")]] twinarm::FclContact* twinarm_fcl_contact();
