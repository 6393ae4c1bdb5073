// G1: results of each fixed-step integrator for a pendulum of 1 m released at 90 degrees, by an
// independent code.
#pragma once

#include <array>

#include "solver/integration/integrator.h"

namespace twinarm {

struct GoldenSteps {
  Integrator integrator;
  double angle, rate;           // at 1 s, h = 10 ms
  std::array<double, 3> error;  // of the angle, h = 10, 5, 2.5 ms
  double energy;                // after 100 s, h = 10 ms, initially 0 [J]
};

const std::array<GoldenSteps, 10>& golden_steps();

}  // namespace twinarm
