// Minima of the sum of two support functions over directions: the smooth part of the narrow phase.
//
//   f(n) = n . c + sqrt(n' A n) + sqrt(n' B n),   A, B symmetric, positive or zero
// f is convex and homogeneous, so on the unit sphere a minimum below zero is the only one (bodies
// apart: minus their distance); minima above zero (bodies overlap) are local.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "solver/spatial/pose.h"

namespace twinarm {

struct SupportSum {
  Vector3 c;
  Matrix3 A, B;
  double operator()(const Vector3& n) const;
};

// Newton's method on the sphere from n, down to the local minimum, to rounding. About 1 us.
Vector3 minimise_on_sphere(const SupportSum& f, const Vector3& n);

// All minima over the unit circle across `axis`, one of each wave that a fan of directions shows,
// appended to `out`. The fan is finer if `is_deep`: beyond the radius of curvature minima may lie
// close together. About 0.5 us, deep 2 us.
void minimise_on_circle(const SupportSum& f, const Vector3& axis, bool is_deep,
                        std::vector<Vector3>& out);

// Directions from which the sphere is searched.
struct Starts {
  std::array<Vector3, 42> n;
  std::size_t count = 0;
  void add(const Vector3& direction) {
    constexpr double none = 1e-9;
    const double length = direction.norm();
    if (length > none) n[count++] = direction / length;
  }
  void add_axes(const Matrix3& R) {
    for (int i = 0; i < 3; ++i) {
      add(R.col(i));
      add(-R.col(i));
    }
  }
};

}  // namespace twinarm
