// Bushing: a linear and a torsional spring-damper at each link (coupling/laws/spring_damper.h).
#include "coupling/laws/spring_damper.h"

namespace twinarm {

CouplingFacts bushing_coupling() {
  return {.name = "bushing",
          .order = 3,
          .discretizations = CouplingFacts::Discretizations::all,
          .gains = CouplingFacts::Gains::two_springs,
          .at_point = true,
          .can_hold = true,
          .make = make_spring_damper<SpringDamperCoupling::Space::frame>};
}

}  // namespace twinarm
