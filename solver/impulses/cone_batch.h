// Contacts with Coulomb friction between free bodies, several side by side in SIMD lanes.
#pragma once

#include <vector>

#include "solver/impulses/local_solution.h"
#include "solver/spatial/batch.h"

namespace twinarm {

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
