#include "coupling/laws/coupling_spec.h"

#include <algorithm>

namespace twinarm {

const std::vector<CouplingFacts>& couplings_in_order() {
  static const std::vector<CouplingFacts> all = [] {
    std::vector<CouplingFacts> sorted = registered_couplings();
    for (CouplingFacts& facts : sorted)
      if (facts.type.name.empty()) facts.type.name = facts.name;
    std::ranges::stable_sort(sorted, {}, &CouplingFacts::order);
    return sorted;
  }();
  return all;
}

const CouplingFacts& facts_of(CouplingSpec::Type type, bool printed) {
  return *std::find_if(all_couplings.begin(), all_couplings.end(), [&](const CouplingFacts& facts) {
    return facts.type == type && facts.printed == printed;
  });
}

const CouplingFacts* find_coupling(const std::string& name) {
  for (const CouplingFacts& facts : all_couplings)
    if (facts.name == name) return &facts;
  return nullptr;
}

}  // namespace twinarm
