// One row of the energy balance.
#pragma once

#include <string>

namespace twinarm {

struct LedgerRow {
  std::string name;
  double work = 0;  // [J]
};

}  // namespace twinarm
