#include <algorithm>
#include <sstream>

#include "benchmarks/engines/engine.h"

namespace twinarm::bench {

std::vector<EngineKind> kinds_in_order() {
  std::vector<EngineKind> kinds = engine_kinds();
  std::stable_sort(kinds.begin(), kinds.end(),
                   [](const EngineKind& a, const EngineKind& b) { return a.order < b.order; });
  return kinds;
}

Engines all_engines() {
  Engines engines;
  for (const EngineKind& kind : kinds_in_order())
    for (auto& engine : kind.make()) engines.push_back(std::move(engine));
  return engines;
}

std::vector<std::string> missing_engines() {
  std::vector<std::string> missing;
  std::istringstream in(TWINARM_MISSING);
  for (std::string name; std::getline(in, name, ',');) missing.push_back(name);
  return missing;
}

}  // namespace twinarm::bench
