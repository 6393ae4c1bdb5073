// Minima of the sum of two support functions over directions.
//
//   f(n) = n . c + sqrt(n' A n) + sqrt(n' B n),   A, B symmetric, positive or zero
// f is convex and homogeneous: on the unit sphere a minimum below zero is unique (separated bodies:
// minus their distance); minima above zero (overlapping bodies) are local.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "solver/spatial/pose.h"

namespace twinarm {

struct SupportSum {
  Vector3 c;
  Matrix3 A, B;
  double operator()(const Vector3& n) const {
    return n.dot(c) + std::sqrt(std::max(0.0, n.dot(A * n))) +
           std::sqrt(std::max(0.0, n.dot(B * n)));
  }
};

// Newton's method on the sphere from n to a local minimum. About 1 us.
Vector3 minimise_on_sphere(const SupportSum& f, const Vector3& n);

// Appends all minima over the unit circle normal to `axis` that a sampling shows; finer sampling if
// `is_deep` (beyond the radius of curvature minima can lie close together). About 0.5 us, deep 2
// us.
void minimise_on_circle(const SupportSum& f, const Vector3& axis, bool is_deep,
                        std::vector<Vector3>& out);

// Start directions of a search on the sphere.
struct Starts {
  std::array<Vector3, 42> n;
  std::size_t count = 0;
  void add(const Vector3& direction) {
    constexpr double kMinLength = 1e-9;
    const double length = direction.norm();
    if (length > kMinLength) n[count++] = direction / length;
  }
  void add_axes(const Matrix3& R) {
    for (int i = 0; i < 3; ++i) {
      add(R.col(i));
      add(-R.col(i));
    }
  }
};

}  // namespace twinarm
