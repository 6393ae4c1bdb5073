// Triangles that disagree on which side is outside are brought to agree.
#pragma once

#include <vector>

#include "collision/geometry/mesh.h"

namespace twinarm {

struct MendedWinding {
  std::vector<bool> turned;  // by triangle: its second and third corner were swapped
  bool is_closed = false;    // every edge belongs to two triangles, whose sides now agree
};

// Of a welded mesh. Neighbours are made to agree across every edge that two triangles share, each
// connected surface as most of its area stood before; one that is closed has its outside outside
// (its volume is positive). O(n log n).
MendedWinding mend_winding(TriangleMesh& mesh);

}  // namespace twinarm
