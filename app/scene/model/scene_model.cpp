#include "app/scene/model/scene_model.h"

namespace twinarm {

bool SceneCoupling::needs_semi_implicit() const {
  return treatment != Treatment::explicit_ || law == CouplingSpec::Type::weld_like ||
         facts_of(law, printed).treatments == CouplingFacts::Treatments::own;
}

SceneCoupling::ThirdRow SceneCoupling::third_row() const {
  if (!facts_of(law, printed).is_spring_damper) return ThirdRow::drive;
  if (needs_semi_implicit()) return ThirdRow::implicit;
  return printed ? ThirdRow::as_printed : ThirdRow::none;
}

}  // namespace twinarm
