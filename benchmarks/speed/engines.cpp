// Which engines this build has; CMake says which libraries were found.
#include "benchmarks/speed/engine.h"

namespace twinarm::speed {

Engines all_engines() {
  Engines engines;
  add_twinarm(engines);
#ifdef TWINARM_WITH_MUJOCO
  add_mujoco(engines);
#endif
#ifdef TWINARM_WITH_BULLET
  add_bullet(engines);
#endif
#ifdef TWINARM_WITH_DART
  add_dart(engines);
#endif
#ifdef TWINARM_WITH_SIMBODY
  add_simbody(engines);
#endif
  return engines;
}

}  // namespace twinarm::speed
