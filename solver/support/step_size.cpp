#include "solver/support/step_size.h"

#include <charconv>
#include <cmath>
#include <string>

#include "solver/support/diagnostics.h"

namespace twinarm {

void check_step_size(double h) {
  if (h > 0 && std::isfinite(h)) return;
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, h).ptr;
  throw InputError(
      {{"", 0, "step size", "is " + std::string(text, end) + " s, must be positive and finite",
        "give a step size in seconds, such as 0.001"}});
}

}  // namespace twinarm
