// Linear spring-dampers at points of links (coupling/laws/spring_damper.h).
#include "coupling/laws/spring_damper.h"

namespace twinarm {

CouplingFacts linear_coupling() {
  return {.name = "linear",
          .order = 1,
          .discretizations = CouplingFacts::Discretizations::all,
          .at_point = true,
          .can_hold = true,
          .make = make_spring_damper<SpringDamperCoupling::Space::point>};
}

}  // namespace twinarm
