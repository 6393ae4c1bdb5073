#include "app/scene/read/coupling_keys.h"

#include <algorithm>
#include <string>
#include <vector>

#include "coupling/laws/coupling_spec.h"

namespace twinarm {
namespace {

using CouplingLaw = CouplingSpec::Type;

const CouplingFacts* facts_by_name(const std::string& name) {
  for (const CouplingFacts& facts : all_couplings)
    if (facts.name == name) return &facts;
  return nullptr;
}

// As the reader knows them (app/scene/read/read_coupling.cpp).
std::vector<std::string> keys_that_are_not_of(const CouplingFacts& facts) {
  const CouplingLaw law = facts.type;
  const bool is_weld = law == CouplingLaw::weld_like, is_god = law == CouplingLaw::god_object;
  std::vector<std::string> keys;
  const auto leave_out = [&](bool is_of_law, std::vector<std::string> names) {
    if (!is_of_law) keys.insert(keys.end(), names.begin(), names.end());
  };
  leave_out(facts.at_point, {"point"});
  leave_out(facts.has_measure, {"measure", "outside"});
  leave_out(!is_weld && !is_god, {"stiffness", "damping"});
  leave_out(law == CouplingLaw::bushing, {"turn_stiffness", "turn_damping"});
  leave_out(is_weld, {"time_constant", "damping_ratio", "impedance"});
  leave_out(facts.treatments == CouplingFacts::Treatments::all, {"treatment"});
  leave_out(facts.can_hold, {"rate"});
  leave_out(!facts.printed && !is_god && !is_weld, {"damper"});
  leave_out(!is_god, {"link"});
  return keys;
}

void add_number(Value& table, const char* key, double value, int line) {
  if (!table.find(key)) table.put(key, Value::of(value)).line = line;
}

}  // namespace

void fit_keys_to_type(Value& coupling, int line) {
  const Value* type = coupling.find("type");
  const CouplingFacts* facts = type ? facts_by_name(type->text) : nullptr;
  if (!facts) return;
  const std::vector<std::string> others = keys_that_are_not_of(*facts);
  std::erase_if(coupling.members, [&](const Value& member) {
    return std::find(others.begin(), others.end(), member.key) != others.end();
  });
  const bool has_gains =
      facts->type != CouplingLaw::weld_like && facts->type != CouplingLaw::god_object;
  if (has_gains) add_number(coupling, "stiffness", 1000, line);
  if (facts->type == CouplingLaw::bushing)
    add_number(coupling, "turn_stiffness", 0.01 * coupling.find("stiffness")->number, line);
}

}  // namespace twinarm
