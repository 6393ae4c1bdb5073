#include "solver/impulses/cone_batch.h"

#include <algorithm>

namespace twinarm {

// Compiled for two levels of the instruction set; without contraction, so that the bits are equal.
#if defined(__x86_64__) && defined(__OPTIMIZE__) && !defined(__clang__)
__attribute__((flatten, target_clones("avx2", "default")))
#endif
ConeSums
sweep_cones(std::vector<ConeBatch>& batches, double beta, double* v) {
  using T = ConeBatch::T;
  T squared, largest;
  for (ConeBatch& batch : batches) {
    std::array<T, 3> p, q;
    for (int r = 0; r < 3; ++r) {
      T& direction = batch.direction[r];
      p[r] = batch.p[r] + beta * direction;
      direction = beta > 0 ? beta * direction + batch.change[r] : T();
      q[r] = batch.b[r];
    }
    std::array<std::array<T, 6>, 2> velocity;
    for (int side = 0; side < 2; ++side)
      for (int k = 0; k < 6; ++k) {
        const auto [a, b, c, d] = batch.first[side];
        velocity[side][k] = T::of(T::Lanes{v[a + k], v[b + k], v[c + k], v[d + k]});
        for (int r = 0; r < 3; ++r) q[r] = q[r] + batch.J[side][6 * r + k] * velocity[side][k];
      }
    for (int r = 0; r < 3; ++r)
      for (int s = 0; s < 3; ++s) q[r] = q[r] - batch.local.W[3 * r + s] * p[s];
    const std::array<T, 3> next = solve_cone(batch.mu, q, batch.local);
    T here;
    for (int r = 0; r < 3; ++r) {
      batch.change[r] = next[r] - p[r];
      here = here + batch.change[r] * batch.change[r];
    }
    batch.p = next;
    for (int side = 0; side < 2; ++side)
      for (int k = 0; k < 6; ++k) {
        T sum = velocity[side][k];
        for (int r = 0; r < 3; ++r) sum = sum + batch.Y[side][6 * r + k] * batch.change[r];
        for (int l = 0; l < ConeBatch::kLanes; ++l) v[batch.first[side][l] + k] = sum[l];
      }
    here = here * batch.inverse_rho;
    squared = squared + here;
    here = here * batch.inverse_rho;
    largest = select(largest < here, here, largest);
  }
  ConeSums sums;
  for (int l = 0; l < ConeBatch::kLanes; ++l) {
    sums.squared += squared[l];
    sums.largest = std::max(sums.largest, largest[l]);
  }
  return sums;
}

}  // namespace twinarm
