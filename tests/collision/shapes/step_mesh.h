// A step of two treads as a closed mesh, and as its two boxes.
#pragma once

#include <array>

#include "collision/geometry/mesh.h"
#include "collision/shapes/shape.h"
#include "solver/spatial/pose.h"

namespace twinarm::test {

// 0.3 m by 0.3 m, treads at 0.12 m (x < 0) and 0.05 m. Its flat ends are fans with an obtuse
// triangle (160 degrees).
inline TriangleMesh step_mesh() {
  const std::vector<std::array<double, 2>> outline{{-0.15, 0}, {0.15, 0}, {0.15, 0.05},
                                                   {0, 0.05},  {0, 0.12}, {-0.15, 0.12}};
  TriangleMesh step;
  for (const double y : {-0.15, 0.15})
    for (const auto& [x, z] : outline) step.vertices.emplace_back(x, y, z);
  for (int i = 1; i < 5; ++i) {
    step.triangles.push_back({0, i, i + 1});
    step.triangles.push_back({6, i + 7, i + 6});
  }
  for (int i = 0; i < 6; ++i) {
    const int j = (i + 1) % 6;
    step.triangles.push_back({i, i + 6, j + 6});
    step.triangles.push_back({i, j + 6, j});
  }
  return step;
}

struct CoupledTerm {
  Box box;
  Pose X;
};
inline std::array<CoupledTerm, 2> step_parts() {
  return {{{{{0.15, 0.3, 0.12}}, {Matrix3::Identity(), {-0.075, 0, 0.06}}},
           {{{0.3, 0.3, 0.05}}, {Matrix3::Identity(), {0, 0, 0.025}}}}};
}

}  // namespace twinarm::test
