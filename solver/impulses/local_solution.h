// One constraint with the others held, for conjugate_sweeps.h: of double, or of a Batch with a
// constraint in each lane. q: velocity without this impulse.
#pragma once

#include <array>

#include "solver/spatial/scalar.h"

namespace twinarm {

// W = J M^-1 J^T. With p_n of a cone eliminated by u_n = 0:
//   p_n = a - w . p_t,    S p_t + g = u_t.
template <class T>
struct LocalProblem {
  std::array<T, 9> W{}, inverse{};  // inverse: of W
  std::array<T, 3> S{};             // aa, ab, bb
  std::array<T, 2> w{};
  T lambda = 0;  // estimate: sliding with u_t = -lambda p_t
};

// -W^-1 q
template <class T>
std::array<T, 3> sticking_impulse(const LocalProblem<T>& local, const std::array<T, 3>& q) {
  const std::array<T, 9>& A = local.inverse;
  return {-(A[0] * q[0] + A[1] * q[1] + A[2] * q[2]), -(A[3] * q[0] + A[4] * q[1] + A[5] * q[2]),
          -(A[6] * q[0] + A[7] * q[1] + A[8] * q[2])};
}

// Direction of p_t at lambda, scaled to |p_t| = mu p_n: (p_n, p_t). Then one step of Newton's
// method for lambda on mu p_n / |p_t| = 1, which is linear in lambda if S = s 1, w = 0: lambda
// converges together with the sweeps.
template <class T>
std::array<T, 3> slide(const T& mu, const T& a, const std::array<T, 2>& g, LocalProblem<T>& local) {
  const T &lambda = local.lambda, aa = local.S[0], ab = local.S[1], bb = local.S[2];
  const T x = aa + lambda, y = bb + lambda, scale = T(1) / (x * y - ab * ab);
  const auto solve = [&](const T& r0, const T& r1) {
    return std::array<T, 2>{(y * r0 - ab * r1) * scale, (x * r1 - ab * r0) * scale};
  };
  const auto t = solve(-g[0], -g[1]), slope = solve(-t[0], -t[1]);
  const T norm = sqrt(t[0] * t[0] + t[1] * t[1]), part = T(1) / norm;
  const T p_n = a - local.w[0] * t[0] - local.w[1] * t[1];
  const T ratio = mu * part, error = ratio * p_n - T(1);
  const T change = ratio * (-local.w[0] * slope[0] - local.w[1] * slope[1] -
                            p_n * (t[0] * slope[0] + t[1] * slope[1]) * part * part);
  const T newton = lambda - error / change;
  const T least = T(1e-15) * (aa + bb);  // of a subnormal lambda, each operation is slow
  const T less = select(least < newton, select(newton < lambda, newton, T(0.5) * lambda),
                        T(0.5) * lambda + least);
  const T more = select(lambda < newton, newton, T(2) * lambda + aa + bb);
  const T pushes = select(T(0) < p_n, p_n, T(0));
  const T length = select(T(0) < norm, ratio * pushes, T(0));
  local.lambda = select(error < T(0), more, less);
  return {pushes, length * t[0], length * t[1]};
}

template <class T>
std::array<T, 3> solve_cone(const T& mu, const std::array<T, 3>& q, LocalProblem<T>& local) {
  const std::array<T, 3> sticks = sticking_impulse(local, q);
  const T n = sticks[0], bound = mu * n;
  const auto outside = bound * bound < sticks[1] * sticks[1] + sticks[2] * sticks[2];
  const T sliding = select(q[0] < T(0), select(n < T(0), T(1), select(outside, T(1), T(0))), T(0));
  std::array<T, 3> p = sticks;
  if (is_nonzero(sliding)) {
    const T before = local.lambda, a = -q[0] / local.W[0];
    const std::array<T, 3> slides =
        slide(mu, a, {q[1] + local.W[1] * a, q[2] + local.W[2] * a}, local);
    local.lambda = select(T(0) < sliding, local.lambda, before);
    for (std::size_t r = 0; r < 3; ++r) p[r] = select(T(0) < sliding, slides[r], p[r]);
  }
  for (T& x : p) x = select(q[0] < T(0), x, T(0));
  return p;
}

}  // namespace twinarm
