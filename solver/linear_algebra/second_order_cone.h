// Algebra of the second-order cone Q = {x : x_0 >= |(x_1, x_2)|} for interior-point methods
// (Nesterov and Todd 1997; notation of Alizadeh and Goldfarb 2003).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace twinarm {

using ConeVec = std::array<double, 3>;
using ConeMat = std::array<double, 9>;  // row by row

// x_0^2 - x_1^2 - x_2^2, without cancellation near the boundary.
inline double cone_det(const ConeVec& x) {
  const double t = std::sqrt(x[1] * x[1] + x[2] * x[2]);
  return (x[0] - t) * (x[0] + t);
}
inline double cone_dot(const ConeVec& x, const ConeVec& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}
inline ConeVec times(const ConeMat& A, const ConeVec& x) {
  return {A[0] * x[0] + A[1] * x[1] + A[2] * x[2], A[3] * x[0] + A[4] * x[1] + A[5] * x[2],
          A[6] * x[0] + A[7] * x[1] + A[8] * x[2]};
}
// Jordan product x o y; jordan_solve: y with x o y = b.
inline ConeVec jordan(const ConeVec& x, const ConeVec& y) {
  return {cone_dot(x, y), x[0] * y[1] + y[0] * x[1], x[0] * y[2] + y[0] * x[2]};
}
inline ConeVec jordan_solve(const ConeVec& x, const ConeVec& b) {
  const double y0 = (x[0] * b[0] - x[1] * b[1] - x[2] * b[2]) / cone_det(x);
  return {y0, (b[1] - x[1] * y0) / x[0], (b[2] - x[2] * y0) / x[0]};
}

// Maximum s with x + s d in Q, for x in the interior of Q.
inline double cone_step(const ConeVec& x, const ConeVec& d) {
  double s = std::numeric_limits<double>::infinity();
  if (d[0] < 0) s = -x[0] / d[0];
  const double a = d[0] * d[0] - d[1] * d[1] - d[2] * d[2];
  const double b = x[0] * d[0] - x[1] * d[1] - x[2] * d[2], c = cone_det(x);
  const double under = b * b - a * c;  // a s^2 + 2 b s + c = 0
  if (under < 0) return s;
  const double q = b < 0 ? -b + std::sqrt(under) : -b - std::sqrt(under);
  for (const double root : {c / q, q / a})
    if (root > 0) s = std::min(s, root);
  return s;
}

// Nesterov-Todd scaling: symmetric W with W z = W^-1 x =: t.
struct ConeScaling {
  ConeMat W, W2;
  ConeVec t;
  ConeVec w;  // W^2 = eta^2 (2 w w^T - diag(1, -1, -1)), w_0^2 - |w_1|^2 = 1
  double eta2;
};
inline ConeScaling nesterov_todd(const ConeVec& x, const ConeVec& z) {
  const double det_x = std::sqrt(cone_det(x)), det_z = std::sqrt(cone_det(z));
  const double g = std::sqrt(0.5 * (1 + cone_dot(x, z) / (det_x * det_z)));
  ConeScaling s;
  ConeVec& w = s.w;
  for (int r = 0; r < 3; ++r) w[r] = (x[r] / det_x + (r == 0 ? 1 : -1) * z[r] / det_z) / (2 * g);
  const double eta2 = det_x / det_z, eta = std::sqrt(eta2);
  s.eta2 = eta2;
  for (int r = 0; r < 3; ++r)
    for (int k = 0; k < 3; ++k) {
      const double one = r == k ? 1 : 0;
      s.W2[3 * r + k] = eta2 * (2 * w[r] * w[k] - (r == 0 ? one : -one));
      s.W[3 * r + k] = eta * (r == 0 ? w[k] : k == 0 ? w[r] : one + w[r] * w[k] / (1 + w[0]));
    }
  s.t = times(s.W, z);
  return s;
}

}  // namespace twinarm
