#include "solver/integration/integrator.h"

namespace twinarm {

std::optional<Integrator> find_integrator(std::string_view name) {
  for (const IntegratorFacts& facts : all_integrators)
    if (name == facts.name) return facts.integrator;
  return std::nullopt;
}

}  // namespace twinarm
