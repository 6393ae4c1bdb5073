#include "app/scene/model/scene_model.h"

namespace twinarm {

bool SceneCoupling::needs_semi_implicit() const {
  return treatment != Treatment::explicit_ || law == CouplingSpec::Type::weld_like ||
         facts_of(law, printed).treatments == CouplingFacts::Treatments::own;
}

const char* SceneCoupling::third_row() const {
  if (law == CouplingSpec::Type::god_object) return "drive";
  if (needs_semi_implicit()) return "implicit";
  return printed ? "as_printed" : nullptr;
}

}  // namespace twinarm
