// Local problems of conjugate_sweeps.h: one constraint with the others held, its impulse p [N s]
// and q [m/s], its velocity without p, in the axes of the constraint (normal, tangent, tangent); of
// double, or of a Batch with a constraint in each lane. Contacts with Coulomb friction between free
// bodies are solved in batches. No memory is allocated, bits do not depend on the instruction set.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "solver/spatial/batch.h"

namespace twinarm {

// W = J M^-1 J^T. With p_n of a cone eliminated by u_n = 0:
//   p_n = a - w . p_t,    S p_t + g = u_t,    a = -q_n / W_nn,    g = q_t + a W_nt.
template <class T>
struct LocalProblem {
  std::array<T, 9> W{};
  std::array<T, 3> S{};  // aa, ab, bb
  std::array<T, 2> w{};
  std::array<T, 4> inverse{};  // 1 / W_nn; of S: aa, ab, bb
  T lambda = 0;                // estimate: sliding with u_t = -lambda p_t

  // -S^-1 g
  std::array<T, 2> stick(const T& x, const T& y) const {
    return {-(inverse[1] * x + inverse[2] * y), -(inverse[2] * x + inverse[3] * y)};
  }
  // -W^-1 q
  std::array<T, 3> stick(const std::array<T, 3>& q) const {
    const T a = -q[0] * inverse[0];
    const std::array<T, 2> t = stick(q[1] + W[1] * a, q[2] + W[2] * a);
    return {a - w[0] * t[0] - w[1] * t[1], t[0], t[1]};
  }
};

// Newton's method on mu p_n / |p_t| = 1, which is linear in lambda for S = s 1, w = 0; bracketed.
// Returns (p_n, p_t) with |p_t| = mu p_n. Lanes that do not slide need not converge: active = 0.
template <class T>
std::array<T, 3> slide(const T& mu, const T& a, const std::array<T, 2>& g, T active,
                       LocalProblem<T>& local) {
  constexpr int max_steps = 12;
  constexpr double accurate = 1e-6;  // before the last step
  const auto& [aa, ab, bb] = local.S;
  T low = 0, high = INFINITY, lambda = local.lambda, p_n, ratio;
  std::array<T, 2> t;
  for (int k = 0; k < max_steps; ++k) {
    const T x = aa + lambda, y = bb + lambda, scale = T(1) / (x * y - ab * ab);
    t = {(ab * g[1] - y * g[0]) * scale, (ab * g[0] - x * g[1]) * scale};
    const T sx = (ab * t[1] - y * t[0]) * scale, sy = (ab * t[0] - x * t[1]) * scale;
    const T part = T(1) / sqrt(t[0] * t[0] + t[1] * t[1]);
    p_n = a - local.w[0] * t[0] - local.w[1] * t[1];
    ratio = mu * part;
    const T error = ratio * p_n - T(1);
    const T change =
        ratio * (-local.w[0] * sx - local.w[1] * sy - p_n * (t[0] * sx + t[1] * sy) * part * part);
    const T newton = lambda - error / change;
    const auto more = error < T(0);
    low = select(more, lambda, low), high = select(more, high, lambda);
    const T beyond = select(lambda < T(1e100), T(2) * lambda + aa + bb, lambda);
    const T middle = select(high < T(INFINITY), T(0.5) * (low + high), beyond);
    const T inside = select(low < newton, select(newton < high, newton, middle), middle);
    const auto far = T(accurate) < select(more, -error, error);
    const T next = select(far, inside, select(T(0) < newton, newton, lambda));
    lambda = select(T(0) < active, next, lambda);
    active = select(far, active, T(0));
    if (!is_nonzero(active)) break;
  }
  local.lambda = lambda;
  p_n = select(T(0) < p_n, p_n, T(0));
  ratio = select(ratio < T(INFINITY), ratio * p_n, T(0));
  return {p_n, ratio * t[0], ratio * t[1]};
}

// Impulse of a contact with Coulomb friction: open, sticking or sliding.
template <class T>
std::array<T, 3> solve_cone(const T& mu, const std::array<T, 3>& q, LocalProblem<T>& local) {
  const std::array<T, 3> sticks = local.stick(q);
  const T n = sticks[0], bound = mu * n;
  const auto outside = bound * bound < sticks[1] * sticks[1] + sticks[2] * sticks[2];
  const T sliding = select(q[0] < T(0), select(n < T(0), T(1), select(outside, T(1), T(0))), T(0));
  std::array<T, 3> p = sticks;
  if (is_nonzero(sliding)) {
    const T a = -q[0] * local.inverse[0];
    const std::array<T, 3> slides =
        slide(mu, a, {q[1] + local.W[1] * a, q[2] + local.W[2] * a}, sliding, local);
    for (std::size_t r = 0; r < 3; ++r) p[r] = select(T(0) < sliding, slides[r], p[r]);
  }
  for (T& x : p) x = select(q[0] < T(0), x, T(0));
  return p;
}

// Contacts of different bodies, one in each lane. Blocks of J and of Y = M^-1 J^T: 3 x 6.
struct ConeBatch {
  static constexpr int kLanes = 4;
  using T = Batch<kLanes>;
  std::array<std::array<T, 18>, 2> J{}, Y{};
  LocalProblem<T> local;
  std::array<T, 3> b{}, p{}, change{}, direction{};  // as in ConjugateSweeps
  T mu = 0, inverse_rho = 0;
  std::array<std::array<int, kLanes>, 2> first{};  // index of the body's velocities, six numbers
  std::array<int, kLanes> constraint{};            // its index; -1: none
};

struct ConeSums {
  double squared = 0, largest = 0;  // |change|^2 / rho: sum; |change|^2 / rho^2: maximum
};

// One sweep with a step beta along the conjugate direction. Changes p of the batches and v.
ConeSums sweep_cones(std::vector<ConeBatch>& batches, double beta, double* v);

}  // namespace twinarm
