#include "app/simulate/add_contacts.h"

namespace twinarm {

void check_contacts(const SceneModel& scene, FaultList& faults) {
  const std::string file = scene.description.file.string();
  if (scene.may_touch())
    faults.add({file, 0, "scene", "its bodies can touch, and contacts are not computed yet",
                "keep them apart: collide = false in [[robot]] or [[pair]], or one group"});
  for (const SceneConstraint& constraint : scene.constraints)
    faults.add({file, constraint.line, "constraint '" + constraint.name + "'",
                "constraints are not computed yet", "leave it out"});
}

// >>> The solver of contacts and constraints is plugged in here. <<<
void add_contacts(const SceneModel&, Simulation&) {}

}  // namespace twinarm
