// The larger of two errors, where what is not a number is larger than any: std::max loses it.
#pragma once

#include <cmath>

namespace twinarm {

inline double nan_max(double a, double b) {
  return b <= a || std::isnan(a) ? a : b;
}

}  // namespace twinarm
