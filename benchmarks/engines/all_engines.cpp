#include <algorithm>

#include "benchmarks/engines/engine.h"

namespace twinarm::bench {

std::vector<EngineKind> kinds_in_order() {
  std::vector<EngineKind> kinds = engine_kinds();
  std::ranges::sort(kinds, {}, &EngineKind::order);
  return kinds;
}

Engines engines_of_build(const std::function<bool(const Engine&)>& is_wanted) {
  Engines engines;
  for (const EngineKind& kind : kinds_in_order())
    for (auto& engine : kind.make())
      if (is_wanted(*engine)) engines.push_back(std::move(engine));
  return engines;
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
