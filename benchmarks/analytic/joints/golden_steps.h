// G1: what each integrator of fixed step makes of a pendulum of 1 m, released at 90 degrees:
// numbers of an independent code, which tell at once where one bears another's name.
#pragma once

#include <array>

#include "solver/integration/integrator.h"

namespace twinarm {

struct GoldenSteps {
  Integrator integrator;
  double angle, rate;           // at 1 s, h = 10 ms
  std::array<double, 3> error;  // of the angle, h = 10, 5, 2.5 ms
  double energy;                // after 100 s, h = 10 ms; 0 at the start
};

const std::array<GoldenSteps, 10>& golden_steps();

// A case's name that lives as long as the program: "G1-rk4".
const char* name_of_case(const char* prefix, Integrator integrator);

}  // namespace twinarm
