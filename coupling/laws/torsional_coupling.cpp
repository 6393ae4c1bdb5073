// Torsional spring-dampers on link orientations or joint coordinates
// (coupling/laws/spring_damper.h).
#include "coupling/laws/spring_damper.h"

namespace twinarm {

CouplingFacts torsional_coupling() {
  return {.name = "torsional",
          .order = 2,
          .discretizations = CouplingFacts::Discretizations::all,
          .has_measure = true,
          .can_hold = true,
          .make = [](const CouplingSpec& spec, const Model<double>& model, TargetRobot& kvr) {
            using Space = SpringDamperCoupling::Space;
            const auto make = spec.measure == SpringSpace::joint
                                  ? make_spring_damper<Space::joint>
                                  : make_spring_damper<Space::orientation>;
            return make(spec, model, kvr);
          }};
}

}  // namespace twinarm
