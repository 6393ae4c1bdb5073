// Maximum of two numbers that propagates NaN, unlike std::max.
#pragma once

#include <cmath>

namespace twinarm {

inline double nan_max(double a, double b) {
  return b <= a || std::isnan(a) ? a : b;
}

}  // namespace twinarm
