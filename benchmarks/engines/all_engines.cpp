#include <algorithm>

#include "benchmarks/engines/engine.h"

namespace twinarm::bench {

std::vector<EngineKind> kinds_in_order() {
  std::vector<EngineKind> kinds = engine_kinds();
  std::ranges::sort(kinds, {}, &EngineKind::order);
  return kinds;
}

std::vector<std::string> missing_engines() {
  return {TWINARM_MISSING};
}

std::vector<std::string> names_of(const Engines& engines) {
  std::vector<std::string> names;
  for (const auto& engine : engines) names.push_back(engine->name());
  return names;
}

}  // namespace twinarm::bench
