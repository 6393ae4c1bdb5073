// Where the corners of plain shapes lie in a texture, (0, 0) at its top left, (1, 1) at its bottom
// right. World or body axes: z up.
#pragma once

#include <functional>
#include <vector>

#include "app/render/list/draw_mesh.h"

namespace twinarm {

// Of a box of edge 1, centred: each face shows the whole picture. Of the four at the sides up is z,
// of top and bottom y.
std::vector<CornerUv> places_on_box(const TriangleMesh& box);

// The picture once around z, its left and right border where y = 0 and x < 0; `down` gives how far
// below its upper border a point lies. Facets that look along z show the circle of radius `cap`
// within the picture; 0: there are none.
std::vector<CornerUv> places_around_z(const TriangleMesh& mesh,
                                      const std::function<double(const Vector3&)>& down,
                                      double cap = 0);

}  // namespace twinarm
